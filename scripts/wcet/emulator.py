"""Counts the instructions of every cycle of tapes on the emulated Cortex-M7.

Needs an image of tests/wcet/m7 and the plugin of tests/wcet/count_plugin.c. Raises CountError when the emulator
fails or the image lacks a function.
"""

import pathlib
import re
import subprocess
import tempfile

import tape
from kinds import as_written, kinds

CYCLE, ROWS, COLLISION = "cycle", "with rows", "collision"


class CountError(Exception):
    pass


def stages(text):
    """Returns the functions of a pipeline's cycle, the whole first: {stage: prefix of the demangled name}."""
    found = {ROWS: "tactus::Executive::cycle(", "read": "tactus::Guard::check("}
    section, classes = None, kinds()
    for line in text.splitlines():
        if match := re.match(r"\[(\w+)\]", line):
            section = match[1]
            if section == COLLISION:
                found[COLLISION] = "tactus::(anonymous namespace)::check_collision("
        elif match := re.match(r"type\s*=\s*(\w+)", line):
            found[section] = f"tactus::Status tactus::step_block<tactus::{classes[match[1]]}>("
    found["guard"] = "tactus::Guard::limit("
    if COLLISION in found:
        found[COLLISION] = found.pop(COLLISION)
    return found


def shares(stages, row):
    """Returns a row of counts or times by stage, and that of the cycle: the whole without its rows."""
    each = dict(zip(stages, row))
    return {CYCLE: each[ROWS] - each.get(COLLISION, 0)} | each


def symbols(image, nm="arm-none-eabi-nm"):
    """Returns {demangled name: address} of the functions of an image."""
    listing = subprocess.run([nm, "-C", image], check=True, capture_output=True, text=True).stdout
    rows = (line.split(maxsplit=2) for line in as_written(listing).splitlines())
    return {row[2]: int(row[0], 16) for row in rows if len(row) == 3 and row[1] in "tTwW"}


def addresses(image, prefixes, nm="arm-none-eabi-nm"):
    """Returns the address of the one function that begins with each prefix."""
    known = symbols(image, nm)
    found = []
    for prefix in prefixes:
        matches = {address for name, address in known.items() if name.startswith(prefix)}
        if len(matches) != 1:
            raise CountError(f"{image}: {len(matches)} functions begin with '{prefix}'")
        found += matches
    return found


def emulate(image, plugin, options, reel):
    """Plays a reel; returns the output of the image, a line for every tape."""
    semihosting = f"enable=on,target=native,chardev=sh,arg=wcet,arg={reel}"
    command = ["qemu-system-arm", "-M", "mps2-an500", "-nographic", "-monitor", "none", "-serial", "none"]
    command += ["-chardev", "stdio,id=sh", "-semihosting-config", semihosting]
    command += ["-plugin", ",".join([str(plugin), *options]), "-kernel", str(image)]
    run = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    if run.returncode != 0:
        raise CountError(f"{image}: exit code {run.returncode}: {run.stdout}{run.stderr}")
    return run.stdout.splitlines()


def count(image, plugin, prefixes, tapes, more=()):
    """Plays tapes; returns (final status, rows) of each, with one row per cycle and one count per prefix. `more` are further
    options of the plugin."""
    with tempfile.TemporaryDirectory() as folder:
        reel, calls = pathlib.Path(folder) / "reel", pathlib.Path(folder) / "calls"
        tape.write_reel(reel, tapes)
        options = [f"watch={address:x}" for address in addresses(image, prefixes)] + [f"calls={calls}", *more]
        lines = emulate(image, plugin, options, reel)
        rows = [tuple(map(int, line.split())) for line in calls.read_text().splitlines()]
    if len(lines) != len(tapes):
        raise CountError(f"{image}: {len(lines)} of {len(tapes)} tapes were played")
    played = []
    for line in lines:
        cycles, status = line.split()
        played.append((status, rows[: int(cycles)]))
        rows = rows[int(cycles) :]
    if rows or sum(len(mine) for _, mine in played) != sum(int(line.split()[0]) for line in lines):
        raise CountError(f"{image}: it reports other cycles than were counted")
    return played
