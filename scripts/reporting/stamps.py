"""Stamps: what a run was made from, so that `make run` repeats only the runs of which something has changed."""

import functools
import hashlib
import json
import pathlib
import re
import time

SCRIPTS = pathlib.Path(__file__).resolve().parents[1]
FIGURE = ("figure", "reporting/*.py")  # what draws the figure of a run
STAMP = "stamp.json"
RESULTS = ("summary.json", "scene.json", "pipeline.ini", "log.csv", "waypoints.csv", "output.txt",
           "figure.png", "figure.pdf")


@functools.lru_cache(maxsize=None)
def hash_of(path):
    """Returns the hash of a file; empty if it cannot be read."""
    try:
        return hashlib.sha256(pathlib.Path(path).read_bytes()).hexdigest()
    except OSError:
        return ""


def programs(program):
    """Yields the program and, if it is a script, the programs below build/ that it names."""
    yield program
    try:
        content = pathlib.Path(program).read_bytes()
    except OSError:
        return
    if content.startswith(b"#!"):
        yield from sorted({name.decode() for name in re.findall(rb"build/[\w./-]+", content)})


def trajectory_of(pipeline):
    """Returns the trajectory file that a pipeline file names; none if it names none or cannot be read."""
    try:
        text = pathlib.Path(pipeline).read_text(encoding="utf-8", errors="replace")
    except OSError:
        return None
    section = re.search(r"(?ms)^\s*\[gateway\](.*?)(?=^\s*\[|\Z)", text)
    name = section and re.search(r"(?m)^\s*trajectory\s*=\s*([^#\n]*?)\s*(?:#.*)?$", section.group(1))
    return pathlib.Path(pipeline).parent / name.group(1) if name else None


def inputs(program, pipeline, trajectory):
    """Returns the hash of all that a run is made from: program, pipeline, trajectory and what draws its figure."""
    trajectory = trajectory or trajectory_of(pipeline)
    files = [*programs(program), pipeline, *([trajectory] if trajectory else [])]
    files += sorted(path for pattern in FIGURE for path in SCRIPTS.glob(pattern))
    return hashlib.sha256("\n".join(hash_of(str(file)) for file in files).encode()).hexdigest()


def results(folder):
    """Returns size and time of every file of a run in the folder."""
    found = {name: folder / name for name in RESULTS if (folder / name).exists()}
    return {name: [path.stat().st_size, path.stat().st_mtime_ns] for name, path in found.items()}


def write(folder, made_from):
    """Notes what the run in a folder was made from."""
    stamp = {"inputs": made_from, "results": results(folder)}
    (folder / STAMP).write_text(json.dumps(stamp), encoding="utf-8")


def unchanged(folder, made_from):
    """Returns whether the folder holds, untouched, a run made from the same inputs."""
    try:
        stamp = json.loads((folder / STAMP).read_text(encoding="utf-8"))
        return stamp == {"inputs": made_from, "results": results(folder)}
    except (OSError, ValueError):
        return False


def when(folder):
    """Returns when the run in a folder ended: "12:03", with the date if that is not today's."""
    ended = time.localtime((folder / "summary.json").stat().st_mtime)
    today = time.localtime()[:3] == ended[:3]
    return time.strftime("%H:%M" if today else "%Y-%m-%d %H:%M", ended)
