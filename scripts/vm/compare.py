"""What runs of one pipeline on several machines have in common, and how punctual each machine was.

The kernel's arithmetic has the same bytes everywhere; that of the simulated arm is a library's, which on arm64 is compiled
with fused multiply-adds. So logs may part where the arm reports an increment more, and nowhere else.
"""

import json

COLUMNS = ("machine", "result", "cycles", "slips", "overruns", "latest wake-up", "longest cycle")
MEASURED = "robot."  # the columns that come from the robot


class Parted(Exception):
    """The kernel computed something else; the text says what."""


def judge(first, second, same_library):
    """Returns what two logs have in common. Raises Parted if they differ in what the kernel computed."""
    if first == second:
        return "the same bytes"
    one, other = (text.decode().splitlines() for text in (first, second))
    pairs = enumerate(zip(one, other))
    row = next((number for number, (a, b) in pairs if a != b), min(len(one), len(other)))
    if row in (len(one), len(other)):
        raise Parted(f"{len(other) - 1} rows instead of {len(one) - 1}")
    cells = zip(one[0].split(","), one[row].split(","), other[row].split(","))
    name, was, is_now = next((name, a, b) for name, a, b in cells if a != b)
    text = f"{name} = {is_now} instead of {was} in row {row}"
    if same_library or not name.startswith(MEASURED):
        raise Parted(text)
    return f"the same bytes for {row - 1} rows; then the arm: {text}"


def row_of(name, summary):
    """Returns the figures of a run for the table."""
    figures = [str(summary[key]) for key in ("cycles", "slips", "overruns")]
    times = [summary["realtime"]["latency"]["max_ns"], summary["timing"]["cycle"]["max_ns"]]
    return [name, summary["result"]["name"], *figures, *(f"{time / 1e3:.1f} us" for time in times)]


def show(folders, architectures):
    """Prints a table of the runs in the folders, and what each has in common with the one before; returns whether all
    went well."""
    summaries = {name: json.loads((folder / "summary.json").read_text(encoding="utf-8")) for name, folder in folders.items()}
    table = [COLUMNS, *(row_of(name, summary) for name, summary in summaries.items())]
    widths = [max(map(len, column)) for column in zip(*table)]
    for row in table:
        print("  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip())
    good = not any(each["result"]["code"] or each["slips"] or each["overruns"] for each in summaries.values())
    names = list(folders)
    for before, name in zip(names, names[1:]):
        first, second = ((folders[each] / "log.csv").read_bytes() for each in (before, name))
        try:
            print(f"log of {name} beside {before}: {judge(first, second, architectures[name] == architectures[before])}")
        except Parted as error:
            good = False
            print(f"log of {name} beside {before}: DIFFERS: {error}")
    return good
