"""Tapes that seek the longest cycle: made by hand for what is known to take long, and at random from seeds."""

import random

from tape import Tape

READY = {6: (30, -60, 70, -40, -60, 20), 7: (0, -40, 0, -40, 0, 60, 30)}  # away from limits and singularities
QUINTIC = 3
REST = (0, 0, 0, 0, 0, 0)
# Pose ports by number: the low half of a byte names the motion frame, the high half the wrench's.
BASE, ALL_FRAMES = 0, 0x22
POINT, MOVING, EVERYTHING = 0, 3, 7  # fields: position, velocity and acceleration, the wrench too


def late(cycles, step, turn=12, fields=EVERYTHING, frames=ALL_FRAMES, count=3):
    """Arguments of a trajectory that began `cycles` ago and turns a little."""
    waypoints = []
    for i in range(count):
        beside = (step * (i + 1), -step, step, turn, -turn, turn * (i + 1))
        last = i + 1 == count
        speeds = REST if last or fields & 1 == 0 else (3, -2, 2, 4, 3, -2)
        values = beside + (speeds if fields & 1 else ()) + (REST if fields & 2 else ())
        waypoints.append((200, values + ((5, 4, 3, 2, 1, 1) if fields & 4 else ())))
    return frames, fields, QUINTIC, -cycles, waypoints


def joined(dof, stream, joins, step):
    """In one cycle: points that move, then as many trajectories as there are stores, begun some cycles ago."""
    tape = Tape().numbers("joints", READY[dof]).cycles(60)
    tape.point(BASE, EVERYTHING, (1, 1, 1, 1, 1, 1) + (4, 3, 2, 4, 3, 2) + (2, 2, 2, 2, 2, 2) + (1, 1, 1, 1, 1, 1))
    tape.cycles(12)
    for _ in range(stream):
        tape.point(ALL_FRAMES, EVERYTHING, (1, 1, 1, 1, 1, 1) + (4, 3, 2, 4, 3, 2) + (2, 2, 2, 2, 2, 2) + REST)
    for k in range(joins):
        tape.trajectory(*late(8 + k, step))
    return tape.cycles(30)


def at_limits(dof, signs, velocity):
    """Every joint at a limit and a reference that moves on."""
    tape = Tape().numbers("joints", [127 * sign for sign in signs[:dof]]).cycles(1)
    return tape.point(BASE, 1, (0, 0, 0, 0, 0, 0) + tuple(velocity)).cycles(3)


# Corners of the joints' ranges and twists, +-127ths of 1 m/s and 1 rad/s, in which joint after joint is left out.
CORNERED = (
    ((1, -1, 1, -1, 1, 1, 1), (8, 0, 1, 0, -8, 0)),
    ((1, -1, 1, 1, 1, -1, -1), (0, -1, -1, 8, 8, -3)),
    ((-1, -1, -1, -1, 1, -1, 1), (0, 3, 1, -3, -3, 8)),
    ((-1, -1, -1, -1, -1, -1, -1), (0, 8, 1, 1, -3, -1)),
    ((1, -1, -1, -1, 1, 1, 1), (-1, 3, 0, 8, -8, 3)),
)


def all_at_once(dof, signs, velocity, step):
    """A full mailbox while the joints are at their limits: 13 points, then a trajectory in every store, begun late."""
    tape = Tape().numbers("joints", [127 * sign for sign in signs[:dof]]).cycles(60)
    tape.point(BASE, 1, REST + velocity).cycles(12)
    for _ in range(13):
        tape.point(ALL_FRAMES, EVERYTHING, (1, 1, 1, 1, 1, 1) + velocity + (2, 2, 2, 2, 2, 2) + REST)
    for k in range(3):
        tape.trajectory(*late(8 + k, step))
    return tape.cycles(8)


# Late trajectories whose way in is judged at its dearest: near a corner of the workspace and moving on towards it, the
# hull of every axis is outside the box and the way itself is not, so that all extremes are looked for, and many are found.
# Frames, corner, steps back from it, twist and acceleration there, how late, how long the way, where to, and the twist there.
EDGES = (
    (ALL_FRAMES, (-1, -1, 1), (19, 3, 15), (-16, -4, -13, 9, -18, -2), (-43, 0, -12, 24, -6, 21), 37, 199,
     (3, 17, 8, 0, -15, 11), (0, 21, -2, 29, -15, -20), CORNERED[1][0]),
    (BASE, (1, -1, -1), (16, 12, 21), (18, -18, -19, -15, 5, 9), (2, -28, -6, -29, 14, 33), 36, 198,
     (-16, 14, 12, -1, -13, 6), (3, -1, -24, 27, -30, -14), CORNERED[3][0]),
)  # fmt: skip


def at_edge(dof, frames, corner, back, twist, acceleration, cycles, time, beside, end, signs):
    """Points into a corner of the workspace; then, between two checks of collisions, joints at their limits, a full mailbox
    and a late trajectory."""
    tape = Tape().numbers("joints", READY[dof]).cycles(2)
    for axis in range(3):
        for step in (127,) * 12 + (64, 32, 16, 8, 4, 2, 1):  # those that lead outside are refused
            tape.point(BASE, POINT, [corner[axis] * step if i == axis else 0 for i in range(6)]).cycles(1)
    tape.point(BASE, POINT, [-corner[i] * back[i] for i in range(3)] + [0, 0, 0]).cycles(3)
    tape.numbers("joints", [127 * sign for sign in signs[:dof]])
    for _ in range(14):
        tape.point(ALL_FRAMES, EVERYTHING, (1, 1, 1, 1, 1, 1) + twist + (2, 2, 2, 2, 2, 2) + REST)
    tape.point(BASE, EVERYTHING, REST + twist + acceleration + (1, 1, 1, 1, 1, 1))
    waypoints = [(time, beside + end + REST + (5, 4, 3, 2, 1, 1)), (200, beside + REST + REST + REST)]
    return tape.trajectory(frames, EVERYTHING, QUINTIC, -cycles, waypoints).cycles(1)


def by_hand(dof):
    tapes = [joined(dof, stream, joins, step) for stream in (0, 1, 13) for joins in (1, 3) for step in (1, 4, 12)]
    signs = (1, -1, 1, -1, 1, -1, 1)
    tapes += [at_limits(dof, turned, v) for turned in (signs, [-s for s in signs]) for v in ((90, 60, -60) * 2, REST)]
    tapes += [at_edge(dof, *edge) for edge in EDGES]
    return tapes + [all_at_once(dof, corner, twist, step) for corner, twist in CORNERED for step in (1, 12)]


def random_state(rng, tape, dof):
    """Joints anywhere, many of them at a limit, and what else is measured."""
    wide = rng.choice((0.0, 0.3, 0.9))
    joints = [rng.choice((-127, 127)) if rng.random() < wide else rng.randint(-127, 127) for _ in range(dof)]
    tape.numbers("joints", joints)
    if rng.random() < 0.3:
        tape.numbers("velocities", [rng.randint(-120, 120) for _ in range(dof)])
    if rng.random() < 0.5:
        tape.numbers("wrench", [rng.randint(-100, 100) for _ in range(6)])


def random_values(rng, fields, scale):
    count = 6 * (1 + bin(fields).count("1"))
    return [rng.randint(-scale, scale) for _ in range(count)]


def random_request(rng, tape):
    kind = rng.choice(("point", "point", "trajectory", "trajectory", "other"))
    frames, fields = rng.choice((BASE, 0x11, ALL_FRAMES, 0x33)), rng.choice((POINT, 1, MOVING, EVERYTHING))
    scale = rng.choice((1, 4, 20, 120))
    if kind == "point":
        tape.point(frames, fields, random_values(rng, fields, scale))
    elif kind == "trajectory":
        count = rng.randint(1, 4)
        waypoints = [(rng.randint(20, 255), random_values(rng, fields, scale)) for _ in range(count)]
        waypoints[-1] = (waypoints[-1][0], waypoints[-1][1][:6] + [0] * (len(waypoints[-1][1]) - 6))
        tape.trajectory(frames, fields, rng.randrange(5), rng.choice((0, -5, -20, 10)), waypoints)
    else:
        tape.add(rng.choice(("cancel", "pause", "resume")))
        tape.add("override", bytes([rng.randrange(256)]))


def at_random(dof, seed):
    """Deterministic for a seed."""
    rng = random.Random(seed)
    tape = Tape()
    if rng.random() < 0.5:
        tape.numbers("joints", READY[dof])
    else:
        random_state(rng, tape, dof)
    tape.cycles(rng.randint(1, 30))
    for _ in range(rng.randint(1, 5)):
        for _ in range(rng.choice((1, 3, 16))):
            random_request(rng, tape)
        tape.cycles(rng.randint(1, 20))
        if rng.random() < 0.3:
            random_state(rng, tape, dof)
    return tape
