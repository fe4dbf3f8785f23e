"""The figure of the benchmark: what was commanded, and what was measured beside what is expected, limits as lines."""

import numpy as np
from matplotlib import rc_context
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from bounds import JERK_RMS, STEP
from measures import OURS, execute
from robots import Robot
from tables import on_joints

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
COLOURS = {"0.3/0.7, linear": "#ccaa22", "align, fade, trapezoid": "#bb4488", "cubic, crossfade": "#339944", OURS: "#4477aa"}
OTHER = "#aaaaaa"
LIMIT = {"linewidth": 1.0, "linestyle": (0, (6, 2)), "color": "#a01c10"}
GRID = {"hspace": 0.3, "wspace": 0.45, "left": 0.17, "right": 0.98, "top": 0.97, "bottom": 0.06}
EXCERPT_S = (10.0, 12.0)


def excerpt(axes, rows, tasks, scenario, order, label, factor=1.0):
    """Draws a stretch of the first joint: the command less the intent, or a derivative of the command."""
    drawn = {row["executor"] for row in rows if row["scenario"] == scenario}
    for executor, colour in COLOURS.items():
        if executor not in drawn:
            continue
        drawn_by = dict(scenario=scenario, executor=executor, period_us=1000)
        case, program, folder = next(task for task in tasks if drawn_by.items() <= vars(task[0]).items())
        run = execute(case, Robot(program), folder)
        q = run.q[:, 0]
        values = q - run.intent[:, 0] if order == 0 else np.gradient(np.gradient(q, run.dt), run.dt)
        shown = (run.t >= EXCERPT_S[0]) & (run.t < EXCERPT_S[1])
        width = 1.4 if executor == OURS else 0.9
        axes.plot(run.t[shown], factor * values[shown], color=colour, linewidth=width, label=executor)
        if order == 2:
            limit = Robot(program).limits("joint")[1][0]
            for side in (-limit, limit):
                axes.axhline(side, **LIMIT)
            axes.set_ylim(-2.5 * limit, 2.5 * limit)
    axes.set_xlabel("time [s]")
    axes.set_ylabel(label)
    if drawn:
        axes.legend(loc="upper right", fontsize=7)


def bars(axes, rows, scenario, value, label, limit, log):
    """Draws one bar per executor, with the bound that ours is to keep."""
    chosen = [row for row in on_joints(rows) if row["scenario"] == scenario]
    names = [row["executor"] for row in chosen]
    if not chosen:
        return
    axes.barh(names, [value(row) for row in chosen], color=[COLOURS.get(name, OTHER) for name in names], height=0.7)
    axes.invert_yaxis()
    axes.set_xscale("log" if log else "linear")
    axes.axvline(limit, **LIMIT)
    axes.set_xlabel(label)


# Scenario, row and column of a panel, what its bars are, its label, the bound, whether its scale is logarithmic.
BARS = (
    ("disagree", 1, 0, lambda row: row["jerk_rms"], "jerk rms, 15 mrad of disagreement [rad/s3]", JERK_RMS, True),
    ("loss 30 %", 1, 1, lambda row: row["step_mrad_ms"], "largest step, 30 % of chunks lost [mrad/ms]", STEP, True),
    ("disagree", 2, 0, lambda row: row["shares"][1], "acceleration, share of its limit", 1.0, True),
    ("agree", 2, 1, lambda row: row["delay_ms"], "delay on chunks that agree [ms]; one cycle dashed", 1.0, False),
)


def draw(figure, rows, tasks):
    parts = figure.subplots(3, 2, gridspec_kw=GRID)
    excerpt(parts[0, 0], rows, tasks, "disagree", 0, "command - intent [mrad]", 1e3)
    excerpt(parts[0, 1], rows, tasks, "disagree", 2, "acceleration [rad/s2]; limit dashed")
    for scenario, line, column, *of_bars in BARS:
        bars(parts[line, column], rows, scenario, *of_bars)


def write_figure(rows, tasks, out):
    """Writes figure.png; panels of scenarios that were not run stay empty."""
    with rc_context(STYLE):
        figure = Figure(figsize=(10, 11), dpi=110, facecolor="white")
        FigureCanvasAgg(figure)
        draw(figure, rows, tasks)
        figure.savefig(out / "figure.png")
