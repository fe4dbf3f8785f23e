"""Small pictures of the runs: the arm half way, or where it was to be stopped, the path of its tip, and what is around it, seen from the side."""

import numpy as np
from scipy.spatial import ConvexHull

from reporting import arm, expected, panels, view

ARM, TOOL, BOX, MEASURED, DESIRED = "#aab2bd", "#5f6b7a", "#b9a27c", "#1f5fa8", "#333333"
OUTLINE = "#6d7682"
ROUND = {"solid_capstyle": "round", "solid_joinstyle": "round"}


def desired_path(run):
    """Returns the desired positions of the tip [rows, 3], or None."""
    entry = panels.task_entry(run)
    if entry is None or entry["quantity"] not in ("pose", "joint position"):
        return None
    reference = run.values(entry["reference"])
    return reference[:, :3] if entry["quantity"] == "pose" else arm.tip(run.scene, reference)


def draw(axes, run):
    """Draws a run; the axes have the same scale in both directions."""
    axes.set_axis_off()
    axes.set_aspect("equal")
    if "robot.q" not in run.names():
        return
    q = run.values("robot.q")
    measured, rows = view.tip_path(run)
    ways = [(measured, MEASURED, 1.3)]
    wanted = desired_path(run)
    if wanted is not None:
        ways.insert(0, (wanted[rows], DESIRED, 0.7))
    shown = q[-1:] if expected.stop_stated(run) else q[[len(q) // 2]]
    frames = [frame[0] for frame in arm.link_frames(run.scene, shown)]
    to_view = view.to_view(view.eye(run))
    shapes = []  # (depth, radius, ends, colour)
    for link, a, b, radius in arm.capsules(run.scene):
        ends = (frames[link] @ np.array([[*a, 1], [*b, 1]]).T)[:3].T @ to_view.T
        shapes.append((ends[:, 2].mean(), radius, ends, TOOL if link > len(run.scene["joints"]) else ARM))
    box_points = draw_boxes(axes, run, to_view)
    points = np.vstack([way @ to_view.T for way, _, _ in ways] + [s[2] for s in shapes] + box_points)
    low, high = points[:, :2].min(axis=0) - 0.08, points[:, :2].max(axis=0) + 0.08
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))
    axes.apply_aspect()
    metre = np.diff(axes.transData.transform([[0, 0], [1, 0]])[:, 0])[0] * 72 / axes.figure.dpi  # in points
    for _, radius, ends, colour in sorted(shapes, key=lambda shape: shape[0]):
        width = 2 * radius * metre
        axes.plot(*ends[:, :2].T, color=OUTLINE, linewidth=width + 0.8, **ROUND)
        axes.plot(*ends[:, :2].T, color=colour, linewidth=width, **ROUND)
    for way, colour, width in ways:
        axes.plot(*(way @ to_view.T)[:, :2].T, color=colour, linewidth=width)


def draw_alone(figure, run):
    """Draws a run into a whole figure."""
    draw(figure.add_axes([0, 0, 1, 1]), run)


def draw_boxes(axes, run, to_view):
    """Draws the faces of the boxes that are there and the edges of those that are not; returns their corners."""
    there, all_corners = expected.surroundings(run), []
    for box in run.scene["boxes"]:
        corners, edges = arm.corners(box)
        seen = corners @ to_view.T
        all_corners.append(seen)
        if "inside" in box:
            points = (box["centre"] + arm.surface(box["inside"])[0] @ arm.rotation_matrix(box["rotation"]).T) @ to_view.T
            outline = points[ConvexHull(points[:, :2]).vertices, :2]
            axes.fill(*outline.T, facecolor=BOX if box in there else "none", edgecolor="#7a6a4a", alpha=0.4, linewidth=0.5)
            continue
        if box in there:
            for bit in (1, 2, 4):
                for side in (0, bit):
                    face = [i | side for i in range(8) if not i & bit]
                    order = [face[0], face[1], face[3], face[2]]
                    axes.fill(*seen[order, :2].T, color=BOX, alpha=0.22, linewidth=0)
        for i, j in edges:
            axes.plot(*seen[[i, j], :2].T, color="#7a6a4a", linewidth=0.5)
    return all_corners


def still(run):
    """Returns a picture of a run as an array of pixels."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(2.5, 2.0), dpi=110)
    canvas = FigureCanvasAgg(figure)
    draw_alone(figure, run)
    canvas.draw()
    return np.array(canvas.buffer_rgba())


def sheet(heading, pictures):
    """Returns one figure of all runs, five in a row; `pictures` are pixels and lines of text."""
    from matplotlib import rc_context
    from matplotlib.figure import Figure

    across = min(5, len(pictures))
    down = -(-len(pictures) // across)
    with rc_context({"font.size": 8}):
        figure = Figure(figsize=(2.55 * across, 2.6 * down + 0.5), dpi=110)
        parts = figure.subplots(down, across, squeeze=False).ravel()
        for axes in parts:
            axes.set_axis_off()
        for axes, (pixels, text) in zip(parts, pictures):
            axes.imshow(pixels)
            axes.set_title(text, fontsize=7.5, pad=3)
        figure.suptitle(heading, fontweight="bold", fontsize=11)
        figure.subplots_adjust(0.01, 0.01, 0.99, 1 - 0.95 / (2.6 * down + 0.5), 0.03, 0.3)
    return figure


def write_sheet(path, heading, pictures):
    """Writes the figure of all runs."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    FigureCanvasAgg(sheet(heading, pictures)).print_png(path)
