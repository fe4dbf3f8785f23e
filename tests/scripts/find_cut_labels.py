#!/usr/bin/python3
"""find_cut_labels.py OUT RUN...: draws the figures of runs as the report does and names every label that is cut.

A label is a title, the label of an axis or an entry of a legend; it is cut if a part of it is outside of its figure. In
the picture of all runs, a title that is wider than its column counts too.
"""

import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))

from matplotlib import rc_context  # noqa: E402: after the path of the project
from matplotlib.backends.backend_agg import FigureCanvasAgg  # noqa: E402
from matplotlib.figure import Figure  # noqa: E402

from reporting import expected, overview, plots, sections, thumbnails  # noqa: E402


def labels(figure):
    for axes in figure.findobj(lambda thing: hasattr(thing, "xaxis")):
        yield from (axes.xaxis.label, axes.yaxis.label, axes.title, axes._left_title, axes._right_title)
        if axes.get_legend():
            yield from axes.get_legend().get_texts()


def cut_labels(figure):
    """Returns the labels of a figure that are cut."""
    FigureCanvasAgg(figure).draw()
    whole, cut = figure.bbox, []
    for label in labels(figure):
        box = label.get_window_extent()
        if label.get_text() and not (box.x0 >= 0 and box.y0 >= 0 and box.x1 <= whole.x1 and box.y1 <= whole.y1):
            cut.append(label.get_text())
    return cut


def wide_titles():
    """Returns the lines that are wider than their column in the picture of runs with long texts."""
    judgement = expected.Judgement("", "0.249 rad", "0.246 rad ± 24.6 mrad", "", "", True)
    runs = [
        sections.Section(name=f"ur10_jrg_pid:ur10_five_waypoints_{i}", kind="simulated", judgement=judgement, still=[[0]])
        for i in range(5)
    ]
    figure = thumbnails.sheet("5 of 5 runs as expected.", list(overview.sheet(runs)))
    FigureCanvasAgg(figure).draw()
    column = figure.bbox.width / len(runs)
    titles = [axes.title for axes in figure.axes]
    assert all(title.get_text() for title in titles)
    return [title.get_text() for title in titles if title.get_window_extent().width > column]


def main():
    found, count = [], []

    def svg(height, draw, *arguments, width=8):
        with rc_context(plots.STYLE):
            figure = Figure(figsize=(width, height))
            draw(figure, *arguments)
            found.extend(f"{draw.__name__}: {text}" for text in cut_labels(figure))
        count.append(draw)
        return "<svg/>"

    plots.svg = svg
    for name in sys.argv[2:]:
        sections.section_of(pathlib.Path(sys.argv[1]), name)
    found.extend(wide_titles())
    print(f"{len(count)} figures, {len(found)} labels cut")
    print("\n".join(found), file=sys.stderr)
    return 0 if count and not found else 1


if __name__ == "__main__":
    sys.exit(main())
