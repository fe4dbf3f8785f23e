"""How near two bodies of the collision check came: links, tool and bodies of the file, at the joints of the log.

It shares nothing with the check itself: a shape is the hull of points and what is within a radius of it; the point of
the hull of all differences of two that is nearest to zero is found by least squares.
"""

import numpy as np
from scipy.optimize import nnls

from reporting import arm
from reporting.inputs import InputError

SIDES = 96  # of the prism around a cylinder
SUM = 1e3  # weight of the sum of the shares, which is 1
OVERLAP_M = 1e-7  # hulls that are nearer than this have no direction between them


def core(inside):
    """Returns the points whose hull, with its rounding, is what is inside a box of scene.json, or contains it."""
    if inside["core"] == "hull":
        return np.array(inside["points"], dtype=float)
    half = np.array(inside["half"], dtype=float)
    if inside["core"] == "cylinder":
        turns, out = np.arange(SIDES) * 2 * np.pi / SIDES, 1 / np.cos(np.pi / SIDES)
        return np.array([[out * half[0] * np.cos(a), out * half[0] * np.sin(a), z] for a in turns for z in (half[2], -half[2])])
    return half * (np.array([[i & 1, i >> 1 & 1, i >> 2 & 1] for i in range(8)]) * 2.0 - 1.0)


def shapes(run, frames, name):
    """Returns the shapes of a body, each a list of what it is within at once: points [rows or 1, n, 3] in the base frame, and a radius."""
    for box in run.scene["boxes"]:
        if box["name"] == name:
            inside = box.get("inside", {"core": "box", "half": np.array(box["size"]) / 2, "rounding": 0.0})
            return [[((box["centre"] + core(inside) @ arm.rotation_matrix(box["rotation"]).T)[None], inside["rounding"])]]
    tool, links = run.scene["tool"], run.scene.get("links", [])
    if name == "tool":
        local = [(-1, [(tool.get("points") or [[0, 0, 0], tool["tip"]], tool["radius"])])]
    elif name in links:
        link = links.index(name)
        hulls = [(hull["points"], hull["rounding"]) for hull in run.scene.get("hulls", []) if hull["link"] == link]
        local = [(link, [([c["a"], c["b"]], c["radius"]), *hulls]) for c in run.scene["capsules"] if c["link"] == link]
    else:
        raise InputError(f"{run.folder}/scene.json: no body '{name}'")

    def placed(link, points):
        frame = frames[link]
        return np.array(points, dtype=float) @ np.swapaxes(frame[:, :3, :3], 1, 2) + frame[:, None, :3, 3]

    return [[(placed(link, points), radius) for points, radius in within] for link, within in local]


def apart(first, second):
    """Returns the distance of two hulls [n, 3] and [m, 3], or a little less; 0 if they overlap."""
    differences = (first[:, None] - second).reshape(-1, 3)
    shares, _ = nnls(np.vstack([differences.T, np.full(len(differences), SUM)]), [0, 0, 0, SUM])
    between = shares @ differences / shares.sum()
    length = np.linalg.norm(between)
    return 0.0 if length < OVERLAP_M else ((first @ between).min() - (second @ between).max()) / length


def nearest_of(one, other):
    """Returns the smallest distance of two shapes; leaves out rows before which they cannot have moved near enough."""
    moving = [points for points, _ in one + other if len(points) > 1]
    rows = max(map(len, moving), default=1)
    steps = sum(np.linalg.norm(np.diff(points, axis=0), axis=2).max(axis=1) for points in moving)
    way = np.append(0.0, np.cumsum(steps))  # that points of both have made at most

    def distance(row):
        parts = [[(points[min(row, len(points) - 1)], radius) for points, radius in shape] for shape in (one, other)]
        return max(apart(first, second) - first_radius - second_radius for first, first_radius in parts[0] for second, second_radius in parts[1])

    best, row = distance(rows - 1), 0  # of the last row first: an arm that was stopped is nearest there
    while row < rows:
        here = distance(row)
        best = min(best, here)
        row = max(row + 1, int(np.searchsorted(way, way[row] + here - best, "right")))
    return best


def nearest(run, names):
    """Returns the smallest distance of two bodies in the whole run, m; not more than 0 if they met."""
    frames = arm.link_frames(run.scene, run.values("robot.q"))
    first, second = (shapes(run, frames, name) for name in names)
    return min(nearest_of(one, other) for one in first for other in second)
