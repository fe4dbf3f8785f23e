"""The joint frames of a robot's table: T(i-1, i) = Trans(x, y, z) RotX(roll) RotZ(turn + q), or with Trans(0, 0, q) behind."""

import dataclasses
import math

import numpy as np

from errors import Refused
from reading import Body, turn
from text import euler, plain

SAME = 1e-9  # rad: an angle within this of a quarter turn is one
X, Z = np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.0, 1.0])


@dataclasses.dataclass
class Row:
    offset: np.ndarray
    quarters: int  # of the roll, and what it has beside them
    tilt: float
    turn: float
    prismatic: bool = False

    def rolled(self):
        return turn(X, self.quarters * math.pi / 2) @ turn(X, self.tilt)

    def matrix(self):
        frame = np.eye(4)
        frame[:3, :3] = self.rolled() @ turn(Z, self.turn)
        frame[:3, 3] = self.offset
        return frame


@dataclasses.dataclass
class Table:
    rows: list  # of the joints
    flange: Row
    bodies: list  # in the joint frames
    links: list  # frame of each URDF link in its joint frame, the base first


def rounded(values):
    """Returns numbers without the last digits of a computation in double precision, and no -0."""
    return np.round(values, 15) + 0.0


def in_quarters(angle):
    """Returns the quarter turns nearest to an angle within a half turn, -1 to 2, and the rest of it."""
    quarters = round(angle / (math.pi / 2))
    rest = angle - quarters * math.pi / 2
    return 2 if quarters == -2 else quarters, 0.0 if abs(rest) < SAME else rest


def roll_of(before, axis):
    """Returns quarter turns and tilt from a frame to a frame whose z is the axis, or None."""
    if abs(before[:, 0] @ axis) > 2.0 * SAME:
        return None
    return in_quarters(math.atan2(-before[:, 1] @ axis, before[:, 2] @ axis))


def angle_between(a, b):
    return math.degrees(math.atan2(np.linalg.norm(np.cross(a, b)), a @ b))


def other_tip(tip, axis):
    """Returns the remedy for a tip frame that does not fit the last axis: the least rotation that turns its z to the axis."""
    along = tip[:3, :3].T @ axis
    about = np.cross(Z, along)
    rotation = turn(about / np.linalg.norm(about), math.atan2(np.linalg.norm(about), along[2]))
    return f"give another --tip, or add one: a link that is fixed to it with <origin rpy=\"{plain(euler(rotation))}\"/>"


def x_axis(x, axis, following):
    """Returns x of the frame about `axis`: perpendicular to the axis that follows, as near to the given x as it can be."""
    across = np.cross(axis, following)
    if np.linalg.norm(across) < SAME:
        across = x
    across = across - across @ axis * axis  # of nearly parallel axes the rounding is as large
    across /= np.linalg.norm(across)
    return across if across @ x > -SAME else -across


def table_of(chain):
    """Returns the joint frames that describe the chain, and the inertias in them."""
    frames, frame = [], np.eye(4)
    for joint in chain.joints:
        frame = frame @ joint.origin
        frames.append(frame)
    tip = frame @ chain.flange
    axes = [place[:3, :3] @ joint.axis for place, joint in zip(frames, chain.joints)]
    rows, links, before = [], [np.eye(4)], np.eye(4)
    for i, (joint, place) in enumerate(zip(chain.joints, frames)):
        roll = roll_of(before[:3, :3], axes[i])
        if roll is None:  # of the first joint only: the x of every other frame is chosen for the axis that follows
            raise Refused(f"joint {joint.name}: its axis is at {angle_between(axes[i], np.array(X)):.6g} degrees to x of {chain.base} and at"
                          f" {angle_between(axes[i], Z):.6g} to z; that of the first joint is perpendicular to x of the base; give another"
                          " --base, or add one: a root link to which this is fixed with an <origin> that turns it")
        x = before[:3, 0]
        x_next = tip[:3, 0] if i + 1 == len(axes) else x_axis(x, axes[i], axes[i + 1])
        if abs(x_next @ axes[i]) > SAME:
            raise Refused(f"link {chain.tip}: its x is at {angle_between(axes[i], x_next):.6g} degrees to the axis of joint {joint.name}; the"
                          f" x of the flange is perpendicular to the last axis; {other_tip(tip, axes[i])}")
        angle = math.atan2(axes[i] @ np.cross(x, x_next), x @ x_next)
        quarters, rest = in_quarters(angle)
        rows.append(Row(rounded(before[:3, :3].T @ (place[:3, 3] - before[:3, 3])), *roll, quarters * math.pi / 2 + rest,
                        joint.prismatic))
        before = before @ rows[-1].matrix()
        links.append(np.linalg.inv(before) @ place)
    roll = roll_of(before[:3, :3], tip[:3, 2])
    flange = Row(rounded(before[:3, :3].T @ (tip[:3, 3] - before[:3, 3])), *roll, 0.0)
    bodies = [joint.body.moved(link) for joint, link in zip(chain.joints, links[1:])]
    return Table(rows, flange, [Body(b.mass, rounded(b.com), rounded(b.tensor)) for b in bodies], links)
