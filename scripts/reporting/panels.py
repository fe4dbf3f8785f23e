"""Chooses what to draw of a run by the quantities of its signals, not by the names of blocks.

A pose is drawn as a position and an orientation. The orientation is the rotation vector, in base axes,
that turns the first reference into the present orientation; it is continuous up to a full turn.
"""

import dataclasses

import numpy as np

from reporting.inputs import InputError

XYZ = ("x", "y", "z")


@dataclasses.dataclass
class Panel:
    """A reference and the signal that follows it, over time; values are [rows, components]."""

    what: str
    unit: str
    labels: list
    t: np.ndarray
    reference: np.ndarray
    measured: np.ndarray
    error: np.ndarray
    entry: dict  # of the summary's tracking
    points: tuple = None  # times and values of the waypoints

    def title(self):
        """Names the quantity; an orientation is three numbers only as a rotation vector."""
        return "rotation vector" if self.what == "orientation" else self.what


def product(a, b):
    """Multiplies quaternions (w, x, y, z) [rows, 4]."""
    w = a[:, :1] * b[:, :1] - np.sum(a[:, 1:] * b[:, 1:], axis=1, keepdims=True)
    v = a[:, :1] * b[:, 1:] + b[:, :1] * a[:, 1:] + np.cross(a[:, 1:], b[:, 1:])
    return np.hstack([w, v])


def inverse(a):
    return a * [1, -1, -1, -1]


def rotation_vector(quaternion):
    """Returns rotation vectors, rad [rows, 3]; the angle is 2 atan2(|v|, w): the quaternion's sign sets the direction."""
    w, v = quaternion[:, 0], quaternion[:, 1:]
    length = np.linalg.norm(v, axis=1)
    angle = 2 * np.arctan2(length, w)
    return v * np.where(length > 1e-12, angle / np.maximum(length, 1e-12), 2.0)[:, None]


def shortest(quaternion):
    """Chooses the signs that make each angle half a turn at most."""
    return np.where(quaternion[:, :1] < 0, -quaternion, quaternion)


def continuous(quaternion):
    """Chooses signs without jumps from row to row; the first row has the smaller angle."""
    flips = np.sum(quaternion[1:] * quaternion[:-1], axis=1) < 0
    signs = np.concatenate([[1], np.cumprod(np.where(flips, -1, 1))])
    return quaternion * (signs * np.where(quaternion[0, 0] < 0, -1, 1))[:, None]


def beside(points, curve, nearest):
    """Gives each point the sign for which it is nearest to the curve's row `nearest`."""
    dots = np.sum(points * curve[nearest], axis=1, keepdims=True)
    return np.where(dots < 0, -points, points)


def points_of(run, entry, first):
    """Returns times and values of the waypoints if they belong to this entry, else None."""
    if run.points is None or entry is not first:
        return None
    times, *values = run.points.values()
    count = len(run.signal(entry["reference"])["columns"])
    if len(values) != count:
        raise InputError(f"{run.folder}/waypoints.csv: {len(values)} columns, expected {count}")
    return times, np.column_stack(values)


def pose_panels(run, entry, points):
    t, reference, measured = run.log["time_s"], *pair(run, entry)
    labels = [f"{axis}" for axis in XYZ]
    position = Panel("position", "m", labels, t, reference[:, :3], measured[:, :3], None, entry)
    position.error = position.reference - position.measured
    first = inverse(reference[:1, 3:])
    desired = continuous(product(reference[:, 3:], first))
    actual = continuous(product(measured[:, 3:], first))
    turn = shortest(product(reference[:, 3:], inverse(measured[:, 3:])))
    orientation = Panel("orientation", "rad", labels, t, rotation_vector(desired), None, None, entry)
    orientation.measured, orientation.error = rotation_vector(actual), rotation_vector(turn)
    if points is not None:
        times, poses = points
        nearest = np.minimum(np.searchsorted(t, times), len(t) - 1)
        turned = beside(product(poses[:, 3:], first), desired, nearest)
        position.points, orientation.points = (times, poses[:, :3]), (times, rotation_vector(turned))
    return [position, orientation]


def pair(run, entry):
    """Returns reference and measurement of a tracking entry, both [rows, components]."""
    reference, measured = run.values(entry["reference"]), run.values(entry["measured"])
    if reference.shape != measured.shape or (entry["quantity"] == "pose" and reference.shape[1] != 7):
        raise InputError(f"{run.folder}/summary.json: {entry['signal']}: numbers of columns differ")
    return reference, measured


def from_generator(run, name):
    return run.signal(name)["type"].endswith("reference_generator")


def task_entry(run):
    """Returns the tracking entry of what was asked for: that of a reference generator, else the first, or None."""
    entries = run.summary["tracking"]
    return next((e for e in entries if from_generator(run, e["reference"])), (entries or [None])[0])


def task_pair(run):
    """Returns the poses of that entry, reference and measured [rows, 7], or None."""
    entry = task_entry(run)
    return pair(run, entry) if entry and entry["quantity"] == "pose" else None


def slope(values, t):
    """Returns the time derivative of values [rows, components]; zero if there is one row only."""
    return np.gradient(values, t, axis=0) if len(t) > 1 else np.zeros_like(values)


def velocity_of(run, reference):
    """Returns the velocity of a joint reference: the recorded one, else its difference."""
    recorded = reference.replace(".q_d", ".dq_d")
    if recorded != reference and recorded in run.names():
        return run.values(recorded)
    return slope(run.values(reference), run.log["time_s"])


def tracking_panels(run):
    """Returns the panels of every tracking entry, the task's first; the waypoints belong to it."""
    first, panels = task_entry(run), []
    for entry in sorted(run.summary["tracking"], key=lambda e: e is not first):
        points = points_of(run, entry, first)
        if entry["quantity"] == "pose":
            panels += pose_panels(run, entry, points)
            continue
        reference, measured = pair(run, entry)
        joint = entry["quantity"].startswith("joint ")
        labels = [f"joint {i + 1}" if joint else str(i + 1) for i in range(reference.shape[1])]
        what, unit, t = f"{entry['quantity']}", entry["unit"], run.log["time_s"]
        error = reference - measured
        panels.append(Panel(what, unit, labels, t, reference, measured, error, entry, points))
    return panels


def signals_of(run, quantity):
    """Returns the names of the recorded signals of a quantity."""
    return [s["name"] for s in run.summary["signals"] if s["quantity"] == quantity]
