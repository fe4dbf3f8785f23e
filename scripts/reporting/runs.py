"""Reads and checks the files of a run: summary.json, scene.json, log.csv, waypoints.csv."""

import dataclasses
import json
import math

import numpy as np

from reporting.inputs import InputError, read_text
from reporting.result import SKIPPED_FILE
from reporting.settings import Settings


@dataclasses.dataclass
class Run:
    """The files of one folder: summary, scene and, by name, the columns of log and waypoints; `points` may be None."""

    name: str
    folder: object
    summary: dict
    scene: dict
    settings: Settings
    log: dict
    points: dict

    def pauses(self):
        """Returns when the drives were disabled and enabled again; that time has no rows, and the log goes on at once."""
        return [e["time_s"] for e in self.summary["events"] if e["from"] == "arming" and e["cause"] == "rearm" and e["time_s"] > 0]

    def names(self):
        """Returns the names of the recorded signals."""
        return [signal["name"] for signal in self.summary["signals"]]

    def signal(self, name):
        """Returns the entry of a recorded signal."""
        for signal in self.summary["signals"]:
            if signal["name"] == name:
                return signal
        raise InputError(f"{self.folder}/summary.json: signals has no {name}")

    def values(self, name):
        """Returns a recorded signal [rows, components]."""
        try:
            return np.column_stack([self.log[column] for column in self.signal(name)["columns"]])
        except KeyError as error:
            raise InputError(f"{self.folder}/log.csv: no column {error}") from error


def check_row(place, line, names):
    """Refuses a row that does not have one number per column."""
    cells = line.split(",")
    if len(cells) != len(names):
        raise InputError(f"{place}: {len(cells)} cells, the header has {len(names)}")
    for name, cell in zip(names, cells):
        try:
            float(cell)
        except ValueError as error:
            raise InputError(f"{place}: {name} is '{cell}', not a number") from error


def read_csv(path):
    """Returns the columns by name, in the order of the file."""
    header, *lines = read_text(path).splitlines() or [""]
    names = header.split(",")
    if names[0] != "time_s":
        raise InputError(f"{path}:1: the header must begin with time_s")
    if not lines:
        raise InputError(f"{path}: no rows after the header")
    try:
        values = np.loadtxt(lines, delimiter=",", comments=None, ndmin=2)
    except ValueError:
        values = np.empty((0, 0))
    if values.shape != (len(lines), len(names)):
        for number, line in enumerate(lines, 2):
            check_row(f"{path}:{number}", line, names)
    if not (np.isfinite(values[0, 0]) and np.all(np.diff(values[:, 0]) > 0)):
        raise InputError(f"{path}: time_s must increase from row to row")
    return dict(zip(names, values.T))


# Every key that a script reads, and the type of its value; "*" stands for every entry.
NUMBERS = ("rate_hz", "cycles", "seed", "slips", "overruns", "recorder_dropped", "static_bytes")
FORM = {
    **{key: (int, float) for key in NUMBERS + ("heap_allocations_in_cycle", "realtime_factor")},
    **{key: str for key in ("pipeline", "robot", "board", "config_hash")},
    "simulated": bool,
    "result": {"code": int, "name": str},
    "guard": {"limited": int, "tripped": int},
    "timing": {"*": {key: (int, float) for key in ("p50_ns", "p99_ns", "max_ns")}},
    "tracking": [
        {
            **{key: str for key in ("signal", "reference", "measured", "quantity", "unit")},
            **{key: [(int, float, type(None))] for key in ("rms", "max", "final")},
        }
    ],
    "events": [{"time_s": (int, float), "cause": str, "status": str, "from": str, "to": str}],
    "signals": [{"name": str, "type": str, "quantity": str, "unit": str, "columns": [str]}],
}


SCENE = {
    "joints": [[(int, float)]],
    "flange": [(int, float)],
    "capsules": [{"link": int, "a": [(int, float)], "b": [(int, float)], "radius": (int, float)}],
    "tool": {"tip": [(int, float)], "radius": (int, float)},
    "boxes": [{"name": str, **{key: [(int, float)] for key in ("centre", "rotation", "size")}}],
    "limits": {"*": [(int, float)]},
}


def check_form(value, form, place):
    """Refuses a value that does not have the form; `place` names it."""
    if isinstance(form, list) and isinstance(value, list):
        for index, entry in enumerate(value):
            check_form(entry, form[0], f"{place}[{index}]")
    elif isinstance(form, dict) and isinstance(value, dict):
        for key in value if "*" in form else form:
            if key not in value:
                raise InputError(f"{place}: no key '{key}'")
            check_form(value[key], form.get("*") or form[key], f"{place}: {key}")
    elif isinstance(form, (list, dict)) or not isinstance(value, form):
        raise InputError(f"{place}: {json.dumps(value)[:40]} is not of the type that a run writes")


def read_json(path, form):
    try:
        value = json.loads(read_text(path))
    except ValueError as error:
        raise InputError(f"{path}: not JSON: {error}") from error
    check_form(value, form, path)
    return value


def read_summary(path):
    return read_json(path, FORM)


BEGUN = ("summary.json", "log.csv", "incomplete.txt", "refused.txt", SKIPPED_FILE)  # a folder with one of them is that of a run


def is_skipped(folder):
    """Returns whether the last run in a folder was skipped, as the computer lacks what it needs."""
    return (folder / SKIPPED_FILE).exists() and not (folder / "summary.json").exists()


def without_result(folder):
    """Says why a folder holds no run that has ended; None if a run has ended, or has not begun, in it."""
    if (folder / "summary.json").exists():
        return None
    if is_skipped(folder):
        return f"{folder}: skipped: {read_text(folder / SKIPPED_FILE).strip()}"
    if (folder / "refused.txt").exists():
        return f"{folder}: refused: {read_text(folder / 'refused.txt').strip()}"
    if (folder / "log.csv").exists() or (folder / "incomplete.txt").exists():
        return f"{folder}: incomplete: the run has ended without a summary.json, or has not ended"
    return None


def folder_of(out, name):
    """Returns the folder of that name; else that of pipeline:trajectory, which run_all names with an underscore."""
    return out / name if (out / name).is_dir() else out / name.replace(":", "_")


def is_refused(summary):
    """Returns whether the run ended before its first cycle."""
    return summary["result"]["code"] != 0 and summary["cycles"] == 0


def read_run(folder, name):
    """Reads all files of a run."""
    summary = read_summary(folder / "summary.json")
    points = folder / "waypoints.csv"
    return Run(
        name,
        folder,
        summary,
        read_json(folder / "scene.json", SCENE),
        Settings(folder / "pipeline.ini"),
        read_csv(folder / "log.csv"),
        read_csv(points) if points.exists() else None,
    )


def largest(numbers):
    """Returns the largest number of a list in which null stands for one that is not finite; nan if it is empty."""
    return max((math.inf if n is None else n for n in numbers), default=math.nan)
