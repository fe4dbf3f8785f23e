"""Draws the figures of a run from the panels that panels.py chose.

matplotlib, which takes longer to import than a report without pictures takes in all, is imported where something is drawn.
"""

import io
import re

import numpy as np

from reporting import expected, panels
from reporting.inputs import InputError
from reporting.result import result_words

SMALL_UNITS = {"rad": ("mrad", 1e3), "m": ("mm", 1e3)}  # for errors
# After Paul Tol's "bright" scheme, which colour-blind readers can tell apart.
COLOURS = ("#4477aa", "#ee6677", "#339944", "#ccaa22", "#55bbdd", "#bb4488", "#888888")
BUCKETS = 300  # per curve; the smallest and the largest value of each are drawn
CURVE = re.compile(r'<path d="M [^"]*" clip-path')  # not the outlines of letters, which are scaled
DECIMALS = re.compile(r"(\d\.\d\d)\d+")  # a hundredth of a point is enough
STYLE = {
    "font.size": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.xmargin": 0,
    "axes.grid": True,
    "grid.color": "#e4e4e4",
    "grid.linewidth": 0.6,
    "legend.frameon": False,
    "savefig.facecolor": "none",
    "svg.hashsalt": "tactus",  # the same run gives the same bytes
}
MEASURED = {"linewidth": 1.9}
REFERENCE = {"linewidth": 0.9, "linestyle": (0, (5, 3))}
WAYPOINT = {"linestyle": "", "marker": "o", "markersize": 5, "markeredgecolor": "black"}
THIN = {"linewidth": 0.8}
PREDICTED = {"linewidth": 1.1, "linestyle": (0, (1, 1.6))}
LIMIT = {"linewidth": 1.0, "linestyle": (0, (6, 2)), "color": "#a01c10"}
GREY = {"color": "#555555"}
MARGINS = {"left": 0.105, "right": 0.84}
OVER_ERROR = {"height_ratios": (3, 1), "hspace": 0.1, "top": 0.93, "bottom": 0.125, **MARGINS}


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


def prepare():
    """Imports what draws, once for the processes that begin after it."""
    import matplotlib.backends.backend_agg  # noqa: F401
    import matplotlib.backends.backend_svg  # noqa: F401


def entry(label, **style):
    """Returns an entry of a legend."""
    from matplotlib.lines import Line2D

    return Line2D([], [], label=label, **style)


def legend(axes, handles):
    axes.legend(handles=handles, loc="upper left", bbox_to_anchor=(1.005, 1.02))


def draw_panel(part, panel, predicted=None):
    """Draws reference and measurement, and below them reference - measured and the error that is predicted, if any."""
    axes, below = part.subplots(2, 1, sharex=True, gridspec_kw=OVER_ERROR)
    small_unit, factor = SMALL_UNITS.get(panel.unit, (panel.unit, 1))
    for i, label in enumerate(panel.labels):
        axes.plot(*thin_out(panel.t, panel.measured[:, i]), color=colour(i), label=label, **MEASURED)
        dark = darker(colour(i))
        axes.plot(*thin_out(panel.t, panel.reference[:, i]), color=dark, **REFERENCE)
        below.plot(*thin_out(panel.t, factor * panel.error[:, i]), color=colour(i), **THIN)
        if predicted is not None:
            below.plot(*thin_out(panel.t, factor * predicted[:, i]), color=dark, **PREDICTED)
        if panel.points:
            axes.plot(panel.points[0], panel.points[1][:, i], color=colour(i), **WAYPOINT)
    axes.set_ylabel(f"{panel.title()} [{panel.unit}]")
    axes.set_title(panel.entry["signal"], loc="right", fontsize=8, **GREY)
    below.set_ylabel(f"error [{small_unit}]")
    below.set_xlabel("time [s]")
    handles = axes.get_legend_handles_labels()[0]
    handles += [entry("reference", **GREY, **REFERENCE)]
    handles += [entry("measured", **GREY, **MEASURED)]
    handles += [entry("waypoint", **GREY, **WAYPOINT)] if panel.points else []
    handles += [entry("expected", **GREY, **PREDICTED)] if predicted is not None else []
    legend(axes, handles)
    part.align_ylabels()


def svg(height, draw, *arguments, width=8):
    """Returns the SVG text of what `draw` draws; sizes in inches, the page is 8 wide."""
    from matplotlib import rc_context
    from matplotlib.backends.backend_svg import FigureCanvasSVG
    from matplotlib.figure import Figure

    with rc_context(STYLE):
        figure = Figure(figsize=(width, height), facecolor="none")
        draw(figure, *arguments)
        text = io.StringIO()
        FigureCanvasSVG(figure).print_svg(text, metadata={"Date": None})
    return CURVE.sub(lambda curve: DECIMALS.sub(r"\1", curve[0]), text.getvalue())


def title(run):
    summary = run.summary
    name, robot = summary["pipeline"], summary["robot"]
    return f"{name}: {robot}, {expected.kind(run)}, {summary['rate_hz']:g} Hz, {result_words(summary)}"


def write_figures(run):
    """Draws all tracking panels, one below the other, into figure.png and .pdf of the run's folder."""
    from matplotlib import rc_context
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    chosen = panels.tracking_panels(run)
    if not chosen:
        raise InputError(f"{run.folder}/summary.json: nothing to draw, because tracking is empty")
    with rc_context({**STYLE, "pdf.fonttype": 42, "savefig.facecolor": "white"}):
        figure = Figure(figsize=(8, 4.2 * len(chosen)), dpi=200)
        FigureCanvasAgg(figure)
        parts = figure.subfigures(len(chosen), 1, squeeze=False)[:, 0]
        for part, panel in zip(parts, chosen):
            draw_panel(part, panel)
        parts[0].axes[0].set_title(title(run), loc="left", fontweight="bold")
        figure.savefig(run.folder / "figure.png")
        figure.savefig(run.folder / "figure.pdf", metadata={"CreationDate": None})
