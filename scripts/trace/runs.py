"""The runs of all shipped pipelines, recorded as tapes, and the jobs that play them."""

import dataclasses
import functools
import importlib.machinery
import importlib.util
import os
import pathlib
import re
import struct
import subprocess
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "wcet"))

import inputs  # noqa: E402
from machines import make  # noqa: E402

BUILD = pathlib.Path("build/trace")
PIPELINES = pathlib.Path("pipelines")
# Sections of a board's wire. The kernel does not see them, and the player has no wire.
WIRE = ("can", "cia402", "ethercat", "ur")
HOSTILE = "hostile"
TO_THE_END = 0xFFFFFFFF
ASKS_LIBCCD = re.compile(r"^(type\s*=\s*(convex|cylinder)\b|(tool|link)_point\s*=)", re.MULTILINE)


class RunError(Exception):
    """A run cannot be recorded; the message says why."""


@dataclasses.dataclass(frozen=True)
class Run:
    """A pipeline and its trajectory; none: the one that the pipeline names; HOSTILE: the tapes made for the worst case."""

    pipeline: str
    trajectory: str
    robot: str

    @property
    def name(self):
        return f"{self.pipeline}:{self.trajectory}" if self.trajectory else self.pipeline

    @property
    def folder(self):
        return BUILD / self.name.replace(":", "-")

    @property
    def recorded(self):
        return self.trajectory != HOSTILE

    @property
    def ends(self):
        """The status of the last cycle."""
        stops = re.search(r"(?m)^collision_stop\b", (PIPELINES / f"{self.pipeline}.ini").read_text(encoding="utf-8"))
        return "kCollision" if stops else "kOk"

    def tapes(self):
        if self.recorded:
            return [(self.folder / "run.tape").read_bytes()]
        return hostile_tapes(self.pipeline)


@functools.lru_cache
def hostile_tapes(pipeline):
    """Returns the tapes that seek the worst case of a pipeline: stops, refusals, late cycles, whatever a client can send."""
    return list((inputs.hostile_tapes(pipeline) | inputs.found_tapes(pipeline)).values())


def all_runs():
    """Returns the runs of every board, sorted; without LIBCCD but those that ask it. Raises RunError if a pipeline is in none."""
    runs = set()
    for board in pathlib.Path("boards").glob("*/board.mk"):
        for line in re.findall(r"^RUNS\s*[+:]?=\s*(.*)$", board.read_text(encoding="utf-8"), re.MULTILINE):
            runs |= {(*word.split(":"), "")[:2] for word in line.split()}
    left_out = {path.stem for path in PIPELINES.glob("*.ini")} - {pipeline for pipeline, _ in runs}
    if left_out:
        raise RunError(f"{', '.join(sorted(left_out))}: in no RUNS of boards/*/board.mk")
    runs = {run for run in runs if os.environ.get("LIBCCD") or not ASKS_LIBCCD.search((PIPELINES / f"{run[0]}.ini").read_text(encoding="utf-8"))}
    runs |= {(pipeline, HOSTILE) for pipeline, _ in runs if (inputs.CORPUS / pipeline).is_dir()}
    return [Run(pipeline, trajectory, pipeline.split("_")[0]) for pipeline, trajectory in sorted(runs)]


def starts():
    """Returns where the arm starts if not where a simulated one does: {pipeline: joints}."""
    loader = importlib.machinery.SourceFileLoader("beside_emulator", "scripts/beside_emulator")
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("beside_emulator", loader))
    loader.exec_module(module)
    return module.STARTS


def text_of(pipeline):
    """Returns the text of a pipeline without the sections of its wire."""
    text = (PIPELINES / f"{pipeline}.ini").read_text(encoding="utf-8")
    for section in WIRE:
        text = re.sub(rf"(?ms)^\[{section}\].*?(?=^\[|\Z)", "", text)
    joints = starts().get(pipeline)
    return text + f"\n[plant]\ninitial_q = {joints}\n" if joints else text


def trajectory_of(run, text):
    """Returns the path of a run's trajectory."""
    if run.trajectory:
        return PIPELINES / "trajectories" / f"{run.trajectory}.csv"
    return PIPELINES / re.search(r"(?m)^trajectory\s*=\s*(\S+)", text)[1]


def record(run, launcher):
    """Records a run on the simulated plant, if its files or its recorder have changed; raises RunError."""
    text, copy = text_of(run.pipeline), run.folder / "pipeline.ini"
    run.folder.mkdir(parents=True, exist_ok=True)
    if not run.recorded:
        copy.write_text(text, encoding="utf-8")
        return
    recorder = pathlib.Path(f"build/{run.robot}_sim/wcet-record")
    make(f"BOARD={run.robot}_sim", f"CXX={launcher} g++".replace("= ", "="), "ARCH=host", "VARIANT=", "LIBCCD=", str(recorder), "trajectories")
    trajectory, tape = trajectory_of(run, text), run.folder / "run.tape"
    inputs = max(path.stat().st_mtime for path in (recorder, trajectory))
    if tape.exists() and tape.stat().st_mtime > inputs and copy.exists() and copy.read_text(encoding="utf-8") == text:
        return
    copy.write_text(text, encoding="utf-8")
    command = [str(recorder), str(copy), str(tape), str(trajectory)]
    if subprocess.run(command, check=False).returncode != 0:
        tape.unlink(missing_ok=True)
        raise RunError(f"{run.name}: {' '.join(command)} has failed")


def write_job(run, path, fill, first=0, last=TO_THE_END, step=0):
    """Writes the job that plays a run: tests/trace/traced_player.hpp."""
    parts = [(run.folder / "pipeline.ini").read_bytes(), *run.tapes()]
    head = struct.pack("<IIIB", first, last, step, fill)
    path.write_bytes(head + b"".join(struct.pack("<I", len(part)) + part for part in parts))
