"""Plays runs on machines and compares their traces with that of the first machine."""

import concurrent.futures
import dataclasses
import os
import pathlib
import struct
import subprocess
import tempfile
import time

from runs import write_job

STEP = 256  # cycles between two hashes
FILLS = (0x00, 0xFF, 0xAA)  # bytes that the memory of the player holds before: of the first machine, and of every other
PATIENCE_S = 1800
SHOWN = 8  # values that differ


@dataclasses.dataclass
class Played:
    """What a machine has printed: lines, the last of them as words; the seconds it took, and over which bytes it played."""

    lines: list
    end: list
    seconds: float
    fill: int

    @property
    def hash(self):
        return self.end[2] if len(self.end) == 5 else "none"


def play(machine, run, fill, **window):
    """Plays a run once."""
    with tempfile.TemporaryDirectory() as folder:
        job = pathlib.Path(folder) / "job"
        write_job(run, job, fill=fill, **window)
        began = time.monotonic()
        try:
            done = subprocess.run(machine.command(run.robot, job), stdin=subprocess.DEVNULL, capture_output=True,
                                  text=True, timeout=PATIENCE_S, check=False)
            said, failed = done.stdout, f"exit code {done.returncode} {done.stderr.strip()}" if done.returncode else ""
        except subprocess.TimeoutExpired:
            said, failed = "", f"not done after {PATIENCE_S} s"
    lines = said.splitlines()
    end = lines.pop().split() if lines and lines[-1].startswith("end ") and not failed else [failed or "no end", *lines[-1:]]
    return Played(lines, end, time.monotonic() - began, fill)


def first_difference(left, right):
    """Returns the index of the first line in which two lists differ, or None."""
    for index, (one, other) in enumerate(zip(left, right)):
        if one != other:
            return index
    return None if len(left) == len(right) else min(len(left), len(right))


def as_number(bits):
    return struct.unpack(">d", bytes.fromhex(bits))[0].hex()


def differing_cycle(reference, machine, run, played):
    """Returns the first cycle in which two machines differ, or None if the fault is in what follows the last."""
    block = first_difference(played[0].lines, played[1].lines)
    if block is None:
        block = min(len(each.lines) for each in played)
    window = {"first": max(0, (block - 1) * STEP), "last": block * STEP, "step": 1}
    each = [play(one, run, before.fill, **window).lines for one, before in zip((reference, machine), played)]
    index = first_difference(*each)
    return None if index is None else window["first"] + index


def explain(reference, machine, run, played, whole_row):
    """Returns the cell of a machine that differs, and lines that say in what."""
    if len(played[1].end) != 5 or len(played[0].end) != 5:
        return "failed", [" ".join(played[1].end)]
    cycle = differing_cycle(reference, machine, run, played)
    if cycle is None:
        return "differs", [f"{one.name}: {' '.join(each.end)}" for one, each in zip((reference, machine), played)]
    rows = [play(one, run, before.fill, first=cycle, last=cycle).lines for one, before in zip((reference, machine), played)]
    index = first_difference(*rows)
    if index is None:
        return f"cycle {cycle}", ["the values of this cycle do not differ"]
    texts = []
    for one, other in zip(*rows):
        (_, name, number, bits), (*_, other_bits) = one.split(), other.split()
        if bits != other_bits or whole_row:
            sign = "  " if bits == other_bits else "!="
            texts.append(f"{name}[{number}] {as_number(bits)} {sign} {as_number(other_bits)}  {bits} {sign} {other_bits}")
    name, number = rows[0][index].split()[1:3] if index < len(rows[0]) else ("more", "0")
    return f"cycle {cycle}, {name}[{number}]", texts if whole_row else texts[:SHOWN]


def judge(reference, machine, run, first, plays, whole_row):
    """Returns the cell of a machine in the table and the lines that explain it; "=" if there is nothing to explain."""
    for again in plays[1:]:
        if again.end != plays[0].end or again.lines != plays[0].lines:
            return "two runs differ", [" ".join(each.end) for each in plays]
    if plays[0].end != first.end or plays[0].lines != first.lines:
        return explain(reference, machine, run, (first, plays[0]), whole_row)
    if run.recorded and (first.end[3:4] != [run.ends] or first.end[4] == "0"):
        return "not the whole run", [" ".join(first.end)]
    return "=", []


def compare(runs, machines, built_s, whole_row, twice):
    """Prints the table; returns whether every machine plays every run alike, to its end. The others play it `twice` too."""
    fills = {machine: FILLS[:2] if machine is machines[0] else FILLS[2:] + FILLS[: 1 if twice else 0] for machine in machines}
    print(f"{'run':40} {'cycles':>6} {'hash':16} " + " ".join(f"{machine.name:>11}" for machine in machines))
    seconds, equal = dict.fromkeys(built_s, 0.0), True
    with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        futures = {(run, machine.name, fill): pool.submit(play, machine, run, fill, step=STEP)
                   for run in runs for machine in machines for fill in fills[machine]}
        for run in runs:
            each = {machine: [futures[run, machine.name, fill].result() for fill in fills[machine]] for machine in machines}
            first = each[machines[0]][0]
            cells, texts = [], []
            for machine, plays in each.items():
                cell, why = judge(machines[0], machine, run, first, plays, whole_row)
                cells.append(cell)
                texts += [f"    {machine.name}: {line}" for line in why]
                seconds[machine.name] += sum(played.seconds for played in plays)
                equal = equal and cell == "="
            cycles = first.end[1] if len(first.end) == 5 else "?"
            print(f"{run.name:40} {cycles:>6} {first.hash:16} " + " ".join(f"{cell:>11}" for cell in cells), flush=True)
            print("".join(f"{text}\n" for text in texts), end="")
    for what, by_machine in (("built", built_s), ("played", seconds)):
        print(f"{what + ', s':64} " + " ".join(f"{by_machine[machine.name]:11.0f}" for machine in machines))
    return equal
