"""Draws what a run did besides following its reference: force, path in a plane, joint limits, torque, flags."""

import numpy as np

from reporting import panels
from reporting.plots import GREY, LIMIT, MARGINS, MEASURED, PREDICTED, REFERENCE, THIN, WAYPOINT
from reporting.plots import colour, darker, entry, legend, thin_out


def mark_pauses(axes, run, words=" drives disabled"):
    """Marks where the drives were disabled: no time passes there in the log, and nothing was given to them."""
    for time_s in run.pauses():
        axes.axvline(time_s, color="#222222", linewidth=2.5, alpha=0.5)
        axes.annotate(words, (time_s, 1), xycoords=axes.get_xaxis_transform(), va="top", fontsize=7)


def draw_force(part, run, found):
    """Draws the force of the environment on the tool, and what is expected of it if a contact was found."""
    axes = part.subplots(gridspec_kw={"top": 0.95, "bottom": 0.17, **MARGINS})
    t, handles = run.log["time_s"], []
    for name in panels.signals_of(run, "wrench"):
        for i, axis in enumerate(panels.XYZ):
            values = run.values(name)[:, i]
            if panels.from_generator(run, name):
                if np.any(values):
                    axes.plot(*thin_out(t, values), color=darker(colour(i)), **REFERENCE)
            else:
                handles += axes.plot(*thin_out(t, values), color=colour(i), label=axis, **THIN)
    if found is not None:
        axes.plot(*thin_out(t, found.force), color="#222222", linewidth=0.6, alpha=0.6)
        handles += [entry("normal", color="#222222", linewidth=0.8, alpha=0.6)]
        handles += axes.plot(*thin_out(t, found.expected), color="black", label="expected", **PREDICTED)
        largest = 1.6 * found.expected.max()
        if np.abs(found.force).max() > largest > 0:
            axes.set_ylim(top=max(largest, np.percentile(found.force, 99.5)))
        steady = t[found.steady]
        if len(steady):
            axes.axvspan(steady[0], steady[-1], color="#88aa88", alpha=0.15, linewidth=0)
    mark_pauses(axes, run)
    axes.set_ylabel("force on the tool [N]")
    axes.set_xlabel("time [s]")
    legend(axes, handles)


def draw_path(part, run):
    """Draws the path of the tip in the plane of the two base axes along which it moves most."""
    tracked = panels.task_entry(run)
    reference, measured = (values[:, :3] for values in panels.pair(run, tracked))
    across, up = sorted(np.argsort(np.ptp(reference, axis=0))[1:])
    axes = part.subplots(gridspec_kw={"top": 0.96, "bottom": 0.14, "left": 0.105, "right": 0.84})
    axes.plot(measured[:, across], measured[:, up], color=colour(0), label="measured", **MEASURED)
    axes.plot(reference[:, across], reference[:, up], color=darker(colour(0)), label="reference", **REFERENCE)
    points = panels.points_of(run, tracked, tracked)
    if points is not None:
        axes.plot(points[1][:, across], points[1][:, up], color=colour(0), label="waypoint", **WAYPOINT)
    axes.set_aspect("equal", adjustable="datalim")
    axes.margins(0.08)
    axes.set_xlabel(f"{panels.XYZ[across]} [m]")
    axes.set_ylabel(f"{panels.XYZ[up]} [m]")
    legend(axes, axes.get_legend_handles_labels()[0])


def shares(run):
    """Returns (what, share of its limit [rows, joints]) for what is known of the joints."""
    limits, t = {key: np.array(values) for key, values in run.scene["limits"].items()}, run.log["time_s"]
    q = run.values("robot.q")
    dq = run.values("robot.dq") if "robot.dq" in run.names() else panels.slope(q, t)
    middle, half = (limits["q_max"] + limits["q_min"]) / 2, (limits["q_max"] - limits["q_min"]) / 2
    found = [
        ("position", (q - middle) / half),
        ("velocity", dq / limits["dq_max"]),
        ("acceleration", panels.slope(dq, t) / limits["ddq_max"]),
    ]
    torque = commanded_torque(run)
    return found + ([("torque", run.values(torque) / limits["tau_max"])] if torque else [])


def commanded_torque(run):
    """Returns the signal that the robot is commanded as torque, if it is recorded, else None."""
    name = run.settings.given("robot", "tau_c")
    return name if name in run.names() else None


def draw_shares(part, run):
    """Draws position, velocity, acceleration and torque of the joints as shares of their limits."""
    found, t = shares(run), run.log["time_s"]
    rows = -(-len(found) // 2)
    grid = {"top": 0.94, "bottom": 0.28 / rows, "hspace": 0.32, "wspace": 0.2, **MARGINS}
    plots = part.subplots(rows, 2, sharex=True, squeeze=False, gridspec_kw=grid).ravel()
    for axes, (what, values) in zip(plots, found):
        for i in range(values.shape[1]):
            axes.plot(*thin_out(t, values[:, i]), color=colour(i), label=f"joint {i + 1}", **THIN)
        for side in (-1, 1):
            axes.axhline(side, **LIMIT)
        mark_pauses(axes, run, words="")
        axes.set_title(what, loc="left", fontsize=9)
        axes.set_yticks([-1, 0, 1])
        axes.set_ylim(-1.15, 1.15)
        axes.set_ylabel("share of limit")
    for axes in plots[max(0, len(found) - 2) : len(found)]:  # the lowest of each column
        axes.set_xlabel("time [s]")
        axes.tick_params(labelbottom=True)
    for axes in plots[len(found) :]:
        axes.set_axis_off()
    handles = plots[0].get_legend_handles_labels()[0] + [entry("limit", **LIMIT)]
    legend(plots[1], handles)


def draw_torque(part, run, name):
    """Draws the commanded torques, and the limits that fit into the plot."""
    axes = part.subplots(gridspec_kw={"top": 0.95, "bottom": 0.17, **MARGINS})
    t, values = run.log["time_s"], run.values(name)
    for i in range(values.shape[1]):
        axes.plot(*thin_out(t, values[:, i]), color=colour(i), label=f"joint {i + 1}", linewidth=1.1)
    mark_pauses(axes, run)
    axes.set_ylabel("commanded torque [N m]")
    axes.set_xlabel("time [s]")
    legend(axes, axes.get_legend_handles_labels()[0] + draw_torque_limits(axes, run, 1.1 * np.abs(values).max()))


def draw_torque_limits(axes, run, largest):
    """Draws the limits up to `largest`; returns an entry of the legend for each, which names its joints."""
    limits, handles = np.array(run.scene["limits"]["tau_max"]), []
    for limit, dashes in zip(sorted(set(limits[limits <= largest])), ((6, 2), (2, 2), (1, 3))):
        style = {**LIMIT, "linestyle": (0, dashes)}
        for side in (-limit, limit):
            axes.axhline(side, **style)
        joints = np.flatnonzero(limits == limit) + 1
        name = f"{joints[0]}–{joints[-1]}" if len(joints) > 1 else f"{joints[0]}"
        handles.append(entry(f"limit of {name}", **style))
    return handles


def draw_flags(part, run, flags, scalars):
    """Draws scalars as lines, and the times at which a flag is set as bands."""
    axes = part.subplots(gridspec_kw={"top": 0.95, "bottom": 0.22, **MARGINS})
    t = run.log["time_s"]
    for i, name in enumerate(scalars):
        axes.plot(*thin_out(t, run.values(name)[:, 0]), color=colour(i), label=name, **MEASURED)
    for i, name in enumerate(flags, len(scalars)):
        is_set = run.values(name)[:, 0] != 0
        ends = axes.get_xaxis_transform()
        band = {"transform": ends, "color": colour(i), "alpha": 0.35, "label": name, "linewidth": 0}
        axes.fill_between(t, 0, 1, where=is_set, step="post", **band)
    mark_pauses(axes, run)
    axes.set_xlim(t[0], t[-1])
    if not scalars:
        axes.set_yticks([])
    axes.set_ylabel("value [1]" if scalars else "set", **GREY)
    axes.set_xlabel("time [s]")
    legend(axes, axes.get_legend_handles_labels()[0])
