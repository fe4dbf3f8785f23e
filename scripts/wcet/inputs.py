"""The tapes among which the worst case of a pipeline is sought: a recorded run, hostile tapes, and results of searches."""

import pathlib
import re

import hostile
import joints

SEEDS = 150
RUN = "run"  # the tape of the recorded run, which defines the typical cycle
CORPUS = pathlib.Path(__file__).resolve().parents[2] / "tests/wcet/corpus"
BUILD = pathlib.Path("build/wcet")
PIPELINES = pathlib.Path("pipelines")
BOARDS = pathlib.Path("boards")


def pipeline_text(pipeline):
    return (PIPELINES / f"{pipeline}.ini").read_text(encoding="utf-8")


def robot_of(pipeline):
    return re.search(r"^name\s*=\s*(\w+)", pipeline_text(pipeline), re.MULTILINE)[1]


def board_of(pipeline):
    """Returns the board for which a pipeline's images are built."""
    return robot_of(pipeline) + "_sim"


def period_us(pipeline):
    return int(re.search(r"^period_us\s*=\s*(\d+)", pipeline_text(pipeline), re.MULTILINE)[1])


def core_of(pipeline):
    """Returns what a pipeline's board states of its core: {"MHZ": its clock, "LIMIT_US": the longest cycle with rows}."""
    text = (BOARDS / board_of(pipeline) / "board.mk").read_text(encoding="utf-8")
    return {key: float(value) for key, value in re.findall(r"^CORE_(\w+)\s*:=\s*([\d.]+)", text, re.MULTILINE)}


def hand_tapes(pipeline):
    """Returns {name: bytes} of the tapes made by hand."""
    dof = joints.count(robot_of(pipeline))
    return {f"hand-{i}": tape.data for i, tape in enumerate(hostile.by_hand(dof))}


def hostile_tapes(pipeline):
    """Returns {name: bytes} of the tapes made by hand and from seeds."""
    dof = joints.count(robot_of(pipeline))
    return hand_tapes(pipeline) | {f"seed-{seed}": hostile.at_random(dof, seed).data for seed in range(SEEDS)}


def found_tapes(pipeline):
    """Returns {name: bytes} of the tapes that a search found and that were kept."""
    return {path.stem: path.read_bytes() for path in sorted((CORPUS / pipeline).glob("*.tape"))}


def all_tapes(pipeline):
    run = {RUN: (BUILD / pipeline / "run.tape").read_bytes()}
    return run | hostile_tapes(pipeline) | found_tapes(pipeline)
