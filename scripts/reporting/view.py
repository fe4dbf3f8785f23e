"""From where a run is looked at: across the arm, so that the path is seen wide, and not through what is touched."""

import numpy as np

from reporting import arm, expected

TURNS = np.concatenate([side * np.linspace(0.6, 2.3, 9) for side in (1, -1)])  # rad, from the arm's reach
RISE = 0.42  # of the eye, per length of its direction in the plane
FRONT = 0.2  # of the normal of a touched face, towards the eye
POINTS = 250  # of a path


def tip_path(run):
    """Returns measured positions of the tip [rows, 3] and the rows of the log they are of."""
    q = run.values("robot.q")
    rows = np.linspace(0, len(q) - 1, POINTS).astype(int)
    return arm.tip(run.scene, q[rows]), rows


def to_view(eye):
    """Returns the matrix [3, 3] to right, up and towards the eye."""
    right = np.cross([0, 0, 1], eye)
    right /= np.linalg.norm(right)
    return np.array([right, np.cross(eye, right), eye])


def eye(run):
    """Returns the direction to the eye [3]."""
    path, _ = tip_path(run)
    found = expected.contact(run)
    middle = path.mean(axis=0)
    reach = np.arctan2(middle[1], middle[0])
    best = None
    for turn in TURNS:
        direction = np.array([np.cos(reach - turn), np.sin(reach - turn), RISE])
        direction /= np.linalg.norm(direction)
        seen = ((path - middle) @ to_view(direction).T)[:, :2]
        score = np.linalg.svd(seen, compute_uv=False)[1]  # the smaller extent of the path on the screen
        score *= 1 + 0.5 * abs(np.sin(turn))  # of an arm too
        if found is not None and found.normal @ direction < FRONT:
            score -= 1e3
        if best is None or score > best[0]:
            best = score, direction
    return best[1]
