"""The table of all runs, for the screen and for the report: one list of cells per run."""

import math

from reporting.runs import largest, result_words

HEADERS = ("run", "robot", "Hz", "result", "worst rms", "worst max", "unit", "limited", "slips", "heap",
           "step us", "x real")
TEXT_COLUMNS = ("run", "robot", "result", "unit")
REFUSED = "refused"  # without a summary the run did not begin
LEGEND = (
    "worst rms, worst max: root mean square and largest difference between reference and measured value, of the worst"
    " component of the first tracking entry; for a pose, of its position in m. limited: cycles in which the guard"
    " changed the command. slips: periods missed. heap: heap calls in cycles. step us: median time of the whole chain"
    " per cycle. x real: simulated time divided by elapsed time."
)


def tracking_of(summary):
    """Returns worst rms and max of the first tracking entry, and their unit."""
    if not summary["tracking"]:
        return math.nan, math.nan, ""
    entry = summary["tracking"][0]
    if entry["quantity"] == "pose":  # x, y, z and an angle, of which the position is shown
        return largest(entry["rms"][:3]), largest(entry["max"][:3]), "m"
    return largest(entry["rms"]), largest(entry["max"]), entry["unit"]


def cells(name, summary):
    """Returns one line of the table."""
    if summary is None:
        return [name, "", "", REFUSED] + [""] * (len(HEADERS) - 4)
    rms, most, unit = tracking_of(summary)
    return [
        name,
        summary["robot"],
        f"{summary['rate_hz']:.0f}",
        result_words(summary),
        "" if math.isnan(rms) else f"{rms:.2e}",
        "" if math.isnan(most) else f"{most:.2e}",
        unit,
        str(summary["guard"]["limited"]),
        str(summary["slips"]),
        str(summary["heap_allocations_in_cycle"]),
        f"{summary['timing']['step']['p50_ns'] / 1e3:.2f}",
        f"{summary['realtime_factor']:.0f}",
    ]


def as_text(summaries):
    """Returns the table for the screen; `summaries` by name, None for a run that was refused."""
    rows = [list(HEADERS)] + [cells(name, summary) for name, summary in summaries.items()]
    widths = [max(map(len, column)) for column in zip(*rows)]
    left = [header in TEXT_COLUMNS for header in HEADERS]
    lines = []
    for row in rows:
        padded = [c.ljust(w) if l else c.rjust(w) for c, w, l in zip(row, widths, left)]
        lines.append("  ".join(padded).rstrip())
    return "\n".join(lines)
