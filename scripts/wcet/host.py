"""Times the cycles of tapes on this host, and counts the instructions of some of them by callgrind.

Needs wcet-replay and wcet-replay-timed of a board.
"""

import pathlib
import re
import subprocess
import tempfile

import emulator
import tape
from inputs import BUILD, board_of


def replay(pipeline, suffix=""):
    return pathlib.Path("build") / board_of(pipeline) / f"wcet-replay{suffix}"


def times(pipeline, prefixes, tapes):
    """A row for every cycle of all tapes, in ns: the cycle's, and that of each function meanwhile."""
    program = replay(pipeline, "-timed")
    with tempfile.TemporaryDirectory() as folder:
        reel, out = pathlib.Path(folder) / "reel", pathlib.Path(folder) / "times"
        tape.write_reel(reel, tapes)
        watched = [f"{address:x}" for address in emulator.addresses(program, prefixes, "nm")]
        subprocess.run([program, BUILD / f"{pipeline}.ini", reel, "times", out, *watched], check=True)
        return [tuple(map(int, line.split())) for line in out.read_text().splitlines()]


def inclusive(dump, prefix):
    """Instructions in the functions that begin so, callees included, of one callgrind dump."""
    command = ["callgrind_annotate", "--inclusive=yes", "--threshold=100", dump]
    listing = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    pattern = re.compile(r"^\s*([\d,]+) \([^)]*\)\s+\S*?:" + re.escape(prefix), re.MULTILINE)
    return max((int(match.replace(",", "")) for match in pattern.findall(listing)), default=0)


def counts(pipeline, wanted, tapes):
    """wanted: {stage: (function's prefix, tape, cycle)} with the tape by number. {stage: instructions}."""
    cycles = sorted({f"{number}:{cycle}" for _, number, cycle in wanted.values()})
    with tempfile.TemporaryDirectory() as folder:
        reel, out = pathlib.Path(folder) / "reel", pathlib.Path(folder) / "dump"
        tape.write_reel(reel, tapes)
        command = ["valgrind", "-q", "--tool=callgrind", "--instr-atstart=no", f"--callgrind-out-file={out}"]
        command += [replay(pipeline), BUILD / f"{pipeline}.ini", reel, "count", *cycles]
        subprocess.run(command, check=True, capture_output=True)
        dumps = {}
        for path in pathlib.Path(folder).glob("dump.*"):
            if match := re.search(r"Client Request: ([\d:]+)", path.read_text()):
                dumps[match[1]] = path
        return {
            stage: inclusive(dumps[f"{number}:{cycle}"], prefix) for stage, (prefix, number, cycle) in wanted.items()
        }
