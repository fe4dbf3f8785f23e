"""The figure of the benchmark: what was commanded, and what was measured beside what is expected, limits as lines."""

import numpy as np
from matplotlib import rc_context
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from bounds import JERK_RMS, STEP
from measures import OURS, execute
from robots import Robot

STYLE = {
    "font.size": 8,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "#e4e4e4",
    "grid.linewidth": 0.6,
    "legend.frameon": False,
}
# After Paul Tol's "bright" scheme, which colour-blind readers can tell apart.
COLOURS = {"0.3/0.7, linear": "#ccaa22", "same, trapezoid": "#bb4488", "cubic, crossfade": "#339944", OURS: "#4477aa"}
OTHER = "#aaaaaa"
LIMIT = {"linewidth": 1.0, "linestyle": (0, (6, 2)), "color": "#a01c10"}
EXCERPT_S = (10.0, 12.0)


def excerpt(axes, rows, tasks, scenario, order, label, factor=1.0):
    """Draws a stretch of the first joint: the command less the intent, or a derivative of the command."""
    drawn = {row["executor"] for row in rows if row["scenario"] == scenario}
    for executor, colour in COLOURS.items():
        if executor not in drawn:
            continue
        case, program, folder = next(
            task for task in tasks if task[0].scenario == scenario and task[0].executor == executor and task[0].period_us == 1000
        )
        run = execute(case, Robot(program), folder)
        values = run.q[:, 0] - run.intent[:, 0] if order == 0 else np.gradient(np.gradient(run.q[:, 0], run.dt), run.dt)
        shown = (run.t >= EXCERPT_S[0]) & (run.t < EXCERPT_S[1])
        axes.plot(run.t[shown], factor * values[shown], color=colour, linewidth=1.4 if executor == OURS else 0.9, label=executor)
        if order == 2:
            limit = Robot(program).limits("joint")[1][0]
            for side in (-limit, limit):
                axes.axhline(side, **LIMIT)
            axes.set_ylim(-2.5 * limit, 2.5 * limit)
    axes.set_xlabel("time [s]")
    axes.set_ylabel(label)
    axes.legend(loc="upper right", fontsize=7)


def bars(axes, rows, scenario, value, label, limit, log):
    """Draws one bar per executor, with the bound that ours is to keep."""
    chosen = [row for row in rows if row["scenario"] == scenario and row["space"] == "joint" and row["period_us"] == 1000]
    chosen = [row for row in chosen if row["robot"] == rows[0]["robot"]]
    names = [row["executor"] for row in chosen]
    axes.barh(names, [value(row) for row in chosen], color=[COLOURS.get(name, OTHER) for name in names], height=0.7)
    axes.invert_yaxis()
    axes.set_xscale("log" if log else "linear")
    axes.axvline(limit, **LIMIT)
    axes.set_xlabel(label)


def draw(figure, rows, tasks):
    scenarios = {row["scenario"] for row in rows}
    parts = figure.subplots(3, 2, gridspec_kw={"hspace": 0.35, "wspace": 0.5, "left": 0.12, "right": 0.98, "top": 0.97, "bottom": 0.06})
    if "sheet" in scenarios:
        excerpt(parts[0, 0], rows, tasks, "sheet", 0, "command - intent [mrad]", 1e3)
        excerpt(parts[0, 1], rows, tasks, "sheet", 2, "acceleration [rad/s2]; limit dashed")
        bars(parts[1, 0], rows, "sheet", lambda row: row["jerk_rms"], "jerk rms, 15 mrad of disagreement [rad/s3]", JERK_RMS, True)
        bars(parts[2, 0], rows, "sheet", lambda row: row["shares"][1], "acceleration, share of its limit", 1.0, True)
    if "loss 30 %" in scenarios:
        bars(parts[1, 1], rows, "loss 30 %", lambda row: row["step_mrad_ms"], "largest step, 30 % of chunks lost [mrad/ms]", STEP, True)
    if "agree" in scenarios:
        bars(parts[2, 1], rows, "agree", lambda row: row["delay_ms"], "delay on chunks that agree [ms]; one cycle dashed", 1.0, False)


def write_figure(rows, tasks, out):
    """Writes figure.png; panels of scenarios that were not run stay empty."""
    with rc_context(STYLE):
        figure = Figure(figsize=(10, 11), dpi=110, facecolor="white")
        FigureCanvasAgg(figure)
        draw(figure, rows, tasks)
        figure.savefig(out / "figure.png")
