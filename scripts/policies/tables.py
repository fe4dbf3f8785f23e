"""The tables of the benchmark, as text that is also Markdown."""

from bounds import judge, place

COLUMNS = (
    ("max step mrad/ms", lambda row: number(row["step_mrad_ms"])),
    ("jerk rms rad/s3", lambda row: number(row["jerk_rms"])),
    ("of v limit", lambda row: number(row["shares"][0])),
    ("of a limit", lambda row: number(row["shares"][1])),
    ("of j limit", lambda row: number(row["shares"][2])),
    ("standstill 1/s", lambda row: number(row["standstills"])),
    ("one axis rests 1/s", lambda row: number(row["axis_rests"])),
    ("delay ms", lambda row: number(row["delay_ms"], 1)),
    ("residual mrad", lambda row: number(row["residual_mrad"], 1)),
    ("SPARC", lambda row: number(row.get("sparc"), 2)),
    ("LDLJ", lambda row: number(row.get("ldlj"), 1)),
    ("reaction ms", lambda row: number(row.get("reaction_ms"), 0)),
)

WORST = ("standstills", "axis_rests", "delay_ms", "residual_mrad", "jerk_rms")


def number(value, places=None):
    """Returns a number with three digits, or with some places; a dash for none."""
    if value is None:
        return "-"
    if places is not None:
        return f"{value:.{places}f}"
    return f"{value:.1e}" if abs(value) >= 10000 else f"{value:.3g}"


def lines(head, rows):
    """Returns a table with columns of equal width."""
    cells = [head, *rows]
    widths = [max(len(row[k]) for row in cells) for k in range(len(head))]
    text = ["| " + " | ".join(cell.ljust(width) for cell, width in zip(row, widths)) + " |" for row in cells]
    return [text[0], "|" + "|".join("-" * (width + 2) for width in widths) + "|", *text[1:]]


# Scenario, heading, places and value of the columns in which executors are compared.
COMPARED = (
    ("disagree", "jerk rms rad/s3", None, lambda row: row["jerk_rms"]),
    ("disagree", "of a limit", None, lambda row: row["shares"][1]),
    ("disagree", "of j limit", None, lambda row: row["shares"][2]),
    ("disagree", "standstill 1/s", 1, lambda row: row["standstills"]),
    ("disagree", "residual mrad", 1, lambda row: row["residual_mrad"]),
    ("agree", "delay ms", 1, lambda row: row["delay_ms"]),
    ("loss 30 %", "max step mrad/ms", None, lambda row: row["step_mrad_ms"]),
    ("loss 30 %", "residual mrad", 0, lambda row: row["residual_mrad"]),
    ("lag", "jerk rms rad/s3", None, lambda row: row["jerk_rms"]),
    ("reaches", "SPARC", 2, lambda row: row.get("sparc")),
    ("reaches", "LDLJ", 1, lambda row: row.get("ldlj")),
    ("switch", "reaction ms", 0, lambda row: row.get("reaction_ms")),
)


def on_joints(rows):
    """Returns the rows of the joints of the first robot at 1 ms."""
    shown = dict(space="joint", period_us=1000, robot=rows[0]["robot"])
    return [row for row in rows if shown.items() <= row.items()]


def compared(rows):
    """Returns the table of all executors over several scenarios."""
    found = {(row["executor"], row["scenario"]): row for row in on_joints(rows)}
    scenarios = {scenario for _, scenario in found}
    columns = [column for column in COMPARED if column[0] in scenarios]
    table = [
        [name, *(number(value(found[name, scenario]), places) for scenario, _, places, value in columns)]
        for name in dict.fromkeys(name for name, _ in found)
    ]
    head = ["executor", *(f"{scenario}: {heading}" for scenario, heading, *_ in columns)]
    return lines(head, table) if columns else []


def by_executor(rows, scenario):
    """Returns the table of one scenario, every executor on the joints of the first robot; none for ours alone."""
    chosen = [row for row in on_joints(rows) if row["scenario"] == scenario]
    if len(chosen) < 2:
        return []
    columns = [column for column in COLUMNS if any(column[1](row) != "-" for row in chosen)]
    table = [[row["executor"], *(value(row) for _, value in columns)] for row in chosen]
    return [f"{scenario}, {chosen[0]['robot']}:", *lines(["executor", *(name for name, _ in columns)], table), ""]


def ours(rows):
    """Returns the table of ours on every scenario, robot and space: the worst over its periods."""
    groups = {}
    for row in rows:
        if row["executor"] == "ours":
            groups.setdefault((row["scenario"], row["robot"], row["space"]), []).append(row)
    table = []
    for key, group in groups.items():
        worst = [max(row["shares"][k] for row in group) for k in range(3)]
        others = [max(abs(row[name]) for row in group) for name in WORST]
        table.append([*key, *(number(value) for value in (*worst, *others))])
    head = ["scenario", "robot", "space", "of v limit", "of a limit", "of j limit", "standstill 1/s"]
    head += ["one axis rests 1/s", "delay ms", "residual mrad", "jerk rms rad/s3"]
    return lines(head, table) if table else []


def verdicts(rows):
    """Returns the bounds beside what was seen, and every result beyond one."""
    judged = judge(rows)
    table = [
        [name, number(limit), number(value), place(worst), "yes" if not beyond else f"NO: {len(beyond)} results"]
        for name, worst, value, limit, beyond in judged
    ]
    text = lines(["ours", "expected", "worst seen", "where", "kept"], table) if table else ["ours: not run"]
    text += [f"beyond: {name}: {number(value)} in {place(row)}" for name, *_, beyond in judged for row, value in beyond]
    return text
