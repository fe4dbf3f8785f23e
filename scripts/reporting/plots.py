"""Draws the figures of a run from the panels that panels.py chose."""

import io
import re

import numpy as np
from matplotlib import rc_context
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from reporting import panels
from reporting.runs import InputError, result_words

SMALL_UNITS = {"rad": ("mrad", 1e3), "m": ("mm", 1e3)}  # for errors
# After Paul Tol's "bright" scheme, which colour-blind readers can tell apart.
COLOURS = ("#4477aa", "#ee6677", "#339944", "#ccaa22", "#55bbdd", "#bb4488", "#888888")
BUCKETS = 600  # per curve; the smallest and the largest value of each are drawn
STYLE = {
    "font.size": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.xmargin": 0,
    "axes.grid": True,
    "grid.color": "#e4e4e4",
    "grid.linewidth": 0.6,
    "legend.frameon": False,
    "svg.hashsalt": "tactus",  # the same run gives the same bytes
}
MEASURED = {"linewidth": 1.9}
REFERENCE = {"linewidth": 0.9, "linestyle": (0, (5, 3))}
WAYPOINT = {"linestyle": "", "marker": "o", "markersize": 5, "markeredgecolor": "black"}
THIN = {"linewidth": 0.8}
GREY = {"color": "#555555"}
MARGINS = {"left": 0.105, "right": 0.84}
OVER_ERROR = {"height_ratios": (3, 1), "hspace": 0.1, "top": 0.93, **MARGINS}


def thin_out(t, values):
    """Thins out a curve for drawing: keeps the smallest and the largest value of every bucket of rows, in order."""
    size = -(-len(t) // BUCKETS)
    if size <= 2 or not np.all(np.isfinite(values)):
        return t, values
    buckets = np.append(values, np.full(-len(t) % size, values[-1])).reshape(-1, size)
    starts = np.arange(0, len(t), size)
    chosen = np.concatenate([[0], starts + buckets.argmin(1), starts + buckets.argmax(1), [len(t) - 1]])
    chosen = np.unique(chosen)
    return t[chosen], values[chosen]


def colour(index):
    return COLOURS[index % len(COLOURS)]


def darker(of):
    return [0.4 * int(of[i : i + 2], 16) / 255 for i in (1, 3, 5)]


def legend(axes, handles):
    axes.legend(handles=handles, loc="upper left", bbox_to_anchor=(1.005, 1.02))


def draw_panel(part, panel):
    """Draws reference and measurement, and below them reference - measured."""
    axes, below = part.subplots(2, 1, sharex=True, gridspec_kw=OVER_ERROR)
    small_unit, factor = SMALL_UNITS.get(panel.unit, (panel.unit, 1))
    for i, label in enumerate(panel.labels):
        axes.plot(*thin_out(panel.t, panel.measured[:, i]), color=colour(i), label=label, **MEASURED)
        dark = darker(colour(i))
        axes.plot(*thin_out(panel.t, panel.reference[:, i]), color=dark, **REFERENCE)
        below.plot(*thin_out(panel.t, factor * panel.error[:, i]), color=colour(i), **THIN)
        if panel.points:
            axes.plot(panel.points[0], panel.points[1][:, i], color=colour(i), **WAYPOINT)
    axes.set_ylabel(f"{panel.what} [{panel.unit}]")
    axes.set_title(panel.entry["signal"], loc="right", fontsize=8, **GREY)
    below.set_ylabel(f"error [{small_unit}]")
    below.set_xlabel("time [s]")
    handles = axes.get_legend_handles_labels()[0]
    handles += [Line2D([], [], label="reference", **GREY, **REFERENCE)]
    handles += [Line2D([], [], label="measured", **GREY, **MEASURED)]
    handles += [Line2D([], [], label="waypoint", **GREY, **WAYPOINT)] if panel.points else []
    legend(axes, handles)
    part.align_ylabels()


def draw_contact(part, run, displacement, wrenches):
    """Draws the displacement that a contact causes, and the forces below it; desired forces are dashed."""
    above, below = part.subplots(2, 1, sharex=True, gridspec_kw={"hspace": 0.1, "top": 0.97, **MARGINS})
    t = run.log["time_s"]
    for i, axis in enumerate(panels.XYZ):
        above.plot(*thin_out(t, 1e3 * displacement[:, i]), color=colour(i), label=axis, **THIN)
        for name in wrenches:
            desired = panels.from_generator(run, name)
            style = {"color": darker(colour(i)), **REFERENCE} if desired else {"color": colour(i), **THIN}
            below.plot(*thin_out(t, run.values(name)[:, i]), **style)
    above.set_ylabel("position error [mm]")
    below.set_ylabel("contact force [N]")
    below.set_xlabel("time [s]")
    handles = above.get_legend_handles_labels()[0]
    legend(above, handles)
    part.align_ylabels()


def draw_limits(part, run, flags, scalars):
    """Draws scalars as lines, and the times at which a flag is set as bands."""
    axes = part.subplots(gridspec_kw={"top": 0.95, "bottom": 0.2, **MARGINS})
    t = run.log["time_s"]
    for i, name in enumerate(scalars):
        axes.plot(*thin_out(t, run.values(name)[:, 0]), color=colour(i), label=name, **MEASURED)
    for i, name in enumerate(flags, len(scalars)):
        is_set = run.values(name)[:, 0] != 0
        ends = axes.get_xaxis_transform()
        band = {"transform": ends, "color": colour(i), "alpha": 0.35, "label": name, "linewidth": 0}
        axes.fill_between(t, 0, 1, where=is_set, step="post", **band)
    axes.set_xlim(t[0], t[-1])
    if not scalars:
        axes.set_yticks([])
    axes.set_ylabel("value [1]" if scalars else "set")
    axes.set_xlabel("time [s]")
    legend(axes, axes.get_legend_handles_labels()[0])


def svg(height, draw, *arguments):
    """Returns the SVG text of what `draw` draws, as wide as the page."""
    with rc_context(STYLE):
        figure = Figure(figsize=(8, height))
        draw(figure, *arguments)
        text = io.StringIO()
        FigureCanvasSVG(figure).print_svg(text, metadata={"Date": None})
    return re.sub(r"(\d\.\d\d)\d+", r"\1", text.getvalue())  # a hundredth of a point is enough


def title(run):
    summary = run.summary
    name, robot = summary["pipeline"], summary["robot"]
    return f"{name}: {robot}, {summary['rate_hz']:g} Hz, {result_words(summary)}"


def write_png(run):
    """Draws all tracking panels, one below the other, into figure.png of the run's folder."""
    chosen = panels.tracking_panels(run)
    if not chosen:
        raise InputError(f"{run.folder}/summary.json: nothing to draw, because tracking is empty")
    with rc_context(STYLE):
        figure = Figure(figsize=(8, 4.8 * len(chosen)), dpi=200)
        canvas = FigureCanvasAgg(figure)
        parts = figure.subfigures(len(chosen), 1, squeeze=False)[:, 0]
        for part, panel in zip(parts, chosen):
            draw_panel(part, panel)
        parts[0].axes[0].set_title(title(run), loc="left", fontweight="bold")
        canvas.print_png(run.folder / "figure.png")
