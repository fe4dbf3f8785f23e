"""Times the cycles of tapes on this host with the executive's stopwatch, and counts instructions of some with callgrind.

Needs wcet-replay of a board.
"""

import pathlib
import re
import subprocess
import tempfile

import emulator
import tape
from inputs import PIPELINES, board_of


def replay(pipeline):
    return pathlib.Path("build") / board_of(pipeline) / "wcet-replay"


def times(pipeline, tapes):
    """Returns (names of the timed stages, rows): a row of times in ns for every cycle of all tapes; 0: did not run."""
    with tempfile.TemporaryDirectory() as folder:
        reel, out = pathlib.Path(folder) / "reel", pathlib.Path(folder) / "times"
        tape.write_reel(reel, tapes)
        subprocess.run([replay(pipeline), PIPELINES / f"{pipeline}.ini", reel, "times", out], check=True)
        names, *lines = out.read_text().splitlines()
        return names.split(), [tuple(map(int, line.split())) for line in lines]


def inclusive(dump, prefix):
    """Returns the instructions, callees included, of the functions with this prefix in one callgrind dump."""
    command = ["callgrind_annotate", "--inclusive=yes", "--threshold=100", dump]
    listing = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    pattern = re.compile(r"^\s*([\d,]+) \([^)]*\)\s+\S*?:" + re.escape(prefix), re.MULTILINE)
    return max((int(match.replace(",", "")) for match in pattern.findall(listing)), default=0)


def counts(pipeline, wanted, stages, tapes):
    """wanted: {stage: (index of tape, cycle)}; stages: {stage: function's prefix}. Returns {stage: instructions}."""
    cycles = sorted({f"{number}:{cycle}" for number, cycle in wanted.values()})
    with tempfile.TemporaryDirectory() as folder:
        reel, out = pathlib.Path(folder) / "reel", pathlib.Path(folder) / "dump"
        tape.write_reel(reel, tapes)
        command = ["valgrind", "-q", "--tool=callgrind", "--instr-atstart=no", f"--callgrind-out-file={out}"]
        command += [replay(pipeline), PIPELINES / f"{pipeline}.ini", reel, "count", *cycles]
        subprocess.run(command, check=True, capture_output=True)
        dumps = {}
        for path in pathlib.Path(folder).glob("dump.*"):
            if match := re.search(r"Client Request: ([\d:]+)", path.read_text()):
                dumps[match[1]] = path
        found = {}
        for stage, (number, cycle) in wanted.items():
            rows = [inclusive(dumps[f"{number}:{cycle}"], prefix) for prefix in stages.values()]
            found[stage] = emulator.shares(stages, rows)[stage]
        return found
