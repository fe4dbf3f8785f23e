"""The tables of all runs: what was seen and expected, for the screen and the page, and the counters of the cycles."""

from reporting.result import result_words

HEADERS = ("run", "robot", "touched", "what", "seen", "expected", "verdict")
REFUSED = "refused"  # without a summary and a log, or without a cycle, the run did not begin
AS_EXPECTED = "as expected"
NOT_COMPARED = "succeeded, not compared"  # nothing that the run recorded says what it should show
SKIPPED = "skipped"  # the computer lacks what the run needs
MOMENT = "%Y-%m-%d %H:%M:%S %Z"  # of a time that the report shows
COUNTERS = ("run", "board", "Hz", "result", "limited", "slips", "heap", "step [µs]", "× real")
COUNTERS_TEXT = ("run", "board", "result")
COUNTERS_LEGEND = (
    "limited: cycles in which the guard changed the command. slips: periods missed. heap: heap calls in cycles. step:"
    " median time of the whole chain per cycle. × real: simulated time divided by elapsed time."
)


def robot_of(section):
    return f"{section.summary['robot']}, {section.kind}" if section.summary and section.kind else ""


def cells(section):
    """Returns one line of the table for the screen."""
    found = section.judgement
    told = (found.what, found.seen, found.expected) if found else ("", "", "")
    return [section.name, robot_of(section), section.touched, *told, section.verdict]


def headline(sections):
    """Counts the runs that were as expected, that succeeded with nothing to compare, and that were skipped."""
    verdicts = [section.verdict for section in sections]
    told = f"{verdicts.count(AS_EXPECTED)} of {len(sections)} runs as expected"
    for verdict, word in ((NOT_COMPARED, "not compared"), (SKIPPED, "skipped")):
        if count := verdicts.count(verdict):
            told += f", {count} {word}"
    return told


def as_text(sections):
    """Returns the table for the screen."""
    rows = [list(HEADERS)] + [cells(section) for section in sections]
    widths = [max(map(len, column)) for column in zip(*rows)]
    lines = ["  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip() for row in rows]
    return "\n".join(lines) + f"\n\n{headline(sections)}"


def counters(section):
    """Returns one line of the counters."""
    summary = section.summary
    if summary is None:
        return [section.name, "", "", section.verdict] + [""] * (len(COUNTERS) - 4)
    return [
        section.name,
        summary["board"],
        f"{summary['rate_hz']:.0f}",
        result_words(summary),
        str(summary["guard"]["limited"]),
        str(summary["slips"]),
        str(summary["heap_allocations_in_cycle"]),
        f"{summary['timing']['step']['p50_ns'] / 1e3:.2f}",
        f"{summary['realtime_factor']:.0f}",
    ]
