"""The arm of scene.json: where its links and its tip are at given joint positions."""

import numpy as np
from scipy.spatial import ConvexHull, QhullError

THIN_M = 1e-4  # what is shown of a body without thickness


def rotation_matrix(quaternion):
    """Returns the matrices [rows, 3, 3] of quaternions w x y z [rows, 4]."""
    w, x, y, z = np.moveaxis(np.asarray(quaternion, float), -1, 0)
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return np.moveaxis(np.array(rows), (0, 1), (-2, -1))


def fixed(frame):
    """Returns the matrix of a frame x, y, z, roll about x, turn about z; prismatic or not."""
    c, s = np.cos(frame[3]), np.sin(frame[3])
    rolled = np.array([[1, 0, 0, frame[0]], [0, c, -s, frame[1]], [0, s, c, frame[2]], [0, 0, 0, 1]], float)
    return rolled @ turn([frame[4]])[0]


def turn(angles):
    """Returns the turns about z [rows, 4, 4]."""
    matrices = np.tile(np.eye(4), (len(angles), 1, 1))
    matrices[:, 0, 0] = matrices[:, 1, 1] = np.cos(angles)
    matrices[:, 1, 0] = np.sin(angles)
    matrices[:, 0, 1] = -matrices[:, 1, 0]
    return matrices


def prismatic(joint):
    """Returns whether a joint of scene.json moves along its axis."""
    return bool(joint[5])


def travels(ways):
    """Returns the travels along z [rows, 4, 4]."""
    matrices = np.tile(np.eye(4), (len(ways), 1, 1))
    matrices[:, 2, 3] = ways
    return matrices


def link_frames(scene, q):
    """Returns the frames of base, links and flange at joint positions [rows, joints]: [rows, 4, 4] each."""
    frames = [np.tile(np.eye(4), (len(q), 1, 1))]
    for joint, values in zip(scene["joints"], q.T):
        frames.append(frames[-1] @ fixed(joint) @ (travels if prismatic(joint) else turn)(values))
    return frames + [frames[-1] @ fixed(scene["flange"])]


def tip(scene, q):
    """Returns the tip of the tool [rows, 3]."""
    return link_frames(scene, q)[-1] @ np.append(scene["tool"]["tip"], 1) @ np.eye(4)[:, :3]


def capsules(scene):
    """Returns (frame, a, b, radius) of links and tool; the frame is an index of link_frames()."""
    shapes = [(c["link"], c["a"], c["b"], c["radius"]) for c in scene["capsules"]]
    tool = scene["tool"]
    if np.any(tool["tip"]):
        shapes.append((len(scene["joints"]) + 1, [0, 0, 0], tool["tip"], tool["radius"]))
    return shapes


def surface(inside):
    """Returns the corners of what is inside a box of scene.json [n, 3], and the triangles between them [m, 3]."""
    half, turns = np.array(inside.get("half", 0.0), dtype=float), np.linspace(0.0, 2.0 * np.pi, 24, endpoint=False)
    points = np.array([[i & 1, i >> 1 & 1, i >> 2 & 1] for i in range(8)]) * 2.0 - 1.0
    points = np.array(inside["points"]) if inside["core"] == "hull" else points * half
    if inside["core"] == "cylinder":
        points = np.array([[half[0] * np.cos(a), half[0] * np.sin(a), z] for a in turns for z in (half[2], -half[2])])
    if inside["rounding"] > 0.0:  # a ball about every point
        rises = np.linspace(-np.pi / 2, np.pi / 2, 13)
        ball = np.array([[np.cos(a) * np.cos(b), np.sin(a) * np.cos(b), np.sin(b)] for a in turns for b in rises])
        points = (points[:, None] + inside["rounding"] * ball).reshape(-1, 3)
    try:
        hull = ConvexHull(points, qhull_options="QJ")
    except QhullError:  # flat
        return surface({**inside, "rounding": THIN_M})
    used, triangles = np.unique(hull.simplices, return_inverse=True)
    corners, triangles = points[used], triangles.reshape(-1, 3)
    one, other, third = np.moveaxis(corners[triangles], 1, 0)
    inward = np.sum(np.cross(other - one, third - one) * hull.equations[:, :3], axis=1) < 0.0
    triangles[inward] = triangles[inward, ::-1]
    return corners, triangles


def corners(box):
    """Returns the eight corners of a box [8, 3], and its twelve edges as pairs of their indices."""
    signs = np.array([[i & 1, i >> 1 & 1, i >> 2 & 1] for i in range(8)]) - 0.5
    points = box["centre"] + (signs * box["size"]) @ rotation_matrix(box["rotation"]).T
    return points, [(i, i | bit) for i in range(8) for bit in (1, 2, 4) if not i & bit]
