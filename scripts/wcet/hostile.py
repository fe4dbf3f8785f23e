"""Tapes that seek the longest cycle: made by hand from requests known to take long, and at random from seeds."""

import math
import random

from tape import Tape

READY = {6: (30, -60, 70, -40, -60, 20), 7: (0, -40, 0, -40, 0, 60, 30)}  # away from limits and singularities
CUBIC, QUINTIC = 2, 3
REST = (0, 0, 0, 0, 0, 0)
# Pose ports by number: the low half of a byte names the motion frame, the high half the wrench frame.
BASE, ALL_FRAMES = 0, 0x22
POINT, MOVING, EVERYTHING = 0, 3, 7  # fields: position, velocity and acceleration, the wrench too


def late(cycles, step, turn=12, fields=EVERYTHING, frames=ALL_FRAMES, count=3):
    """Returns the arguments of a trajectory that began `cycles` ago and turns a little."""
    waypoints = []
    for i in range(count):
        beside = (step * (i + 1), -step, step, turn, -turn, turn * (i + 1))
        last = i + 1 == count
        speeds = REST if last or fields & 1 == 0 else (3, -2, 2, 4, 3, -2)
        values = beside + (speeds if fields & 1 else ()) + (REST if fields & 2 else ())
        waypoints.append((200, values + ((5, 4, 3, 2, 1, 1) if fields & 4 else ())))
    return frames, fields, QUINTIC, -cycles, waypoints


def joined(dof, stream, joins, step):
    """Sends in one cycle moving points, then `joins` trajectories that began some cycles ago."""
    tape = Tape().numbers("joints", READY[dof]).cycles(60)
    tape.point(BASE, EVERYTHING, (1, 1, 1, 1, 1, 1) + (4, 3, 2, 4, 3, 2) + (2, 2, 2, 2, 2, 2) + (1, 1, 1, 1, 1, 1))
    tape.cycles(12)
    for _ in range(stream):
        tape.point(ALL_FRAMES, EVERYTHING, (1, 1, 1, 1, 1, 1) + (4, 3, 2, 4, 3, 2) + (2, 2, 2, 2, 2, 2) + REST)
    for k in range(joins):
        tape.trajectory(*late(8 + k, step))
    return tape.cycles(30)


CLEAR = {6: {2: 70}, 7: {1: 127, 3: 127, 5: 127}}  # joints that keep the arm from touching itself where the others are at limits


def cornered(dof, signs):
    """Puts as many joints at a limit as an arm can that does not touch itself: another is not armed."""
    return Tape().numbers("joints", [CLEAR[dof].get(i, 127 * sign) for i, sign in enumerate(signs[:dof])])


def at_limits(dof, signs, velocity):
    """Puts the joints at limits and sends a reference that goes on moving."""
    tape = cornered(dof, signs).cycles(1)
    return tape.point(BASE, 1, (0, 0, 0, 0, 0, 0) + tuple(velocity)).cycles(3)


# Corners of the joints' ranges, and twists in 127ths of 1 m/s and 1 rad/s that drop one joint after another.
CORNERED = (
    ((1, -1, 1, -1, 1, 1, 1), (8, 0, 1, 0, -8, 0)),
    ((1, -1, 1, 1, 1, -1, -1), (0, -1, -1, 8, 8, -3)),
    ((-1, -1, -1, -1, 1, -1, 1), (0, 3, 1, -3, -3, 8)),
    ((-1, -1, -1, -1, -1, -1, -1), (0, 8, 1, 1, -3, -1)),
    ((1, -1, -1, -1, 1, 1, 1), (-1, 3, 0, 8, -8, 3)),
)


def all_at_once(dof, signs, velocity, step):
    """Fills the mailbox while the joints are at their limits: 13 points, then a trajectory in every store, begun late."""
    tape = cornered(dof, signs).cycles(60)
    tape.point(BASE, 1, REST + velocity).cycles(12)
    for _ in range(13):
        tape.point(ALL_FRAMES, EVERYTHING, (1, 1, 1, 1, 1, 1) + velocity + (2, 2, 2, 2, 2, 2) + REST)
    for k in range(3):
        tape.trajectory(*late(8 + k, step))
    return tape.cycles(8)


def half_wave(count, spacing_s, way, turn, beside):
    """Returns waypoints on half a cosine along x and about z, offset by `beside` in a frame, that end at rest."""
    k, waypoints = math.pi / (count * spacing_s), []
    for i in range(1, count + 1):
        c, s = math.cos(k * i * spacing_s), math.sin(k * i * spacing_s)
        u, du, ddu = 0.5 * (1 - c), 0.5 * k * s * (i < count), 0.5 * k * k * c
        quaternion = (math.cos(0.5 * turn * u), 0, 0, math.sin(0.5 * turn * u))
        along = lambda x: (way * x, 0, 0, 0, 0, turn * x)
        place = (beside[0] + way * u, beside[1], beside[2])
        waypoints.append((i * spacing_s, *place, *quaternion, *along(du), *along(ddu), *(5, 4, 3, 2, 1, 1), *REST))
    return waypoints


# Spacing of the waypoints, distance and turn, within the acceleration limits of each robot.
WAVE = {6: (0.002, 0.0013, 0.0022), 7: (0.001, 0.001, 0.0045)}


def stopped_while_joining(dof, request, wave=None, joints=None, beside=(0.002, 0.001, 0), cycles=12, order=QUINTIC):
    """A path of segments of a cycle or two, joined late from beside it: nearly every place that is looked at ahead lies on
    a segment of its own. It is stopped on before it is joined."""
    tape = Tape().numbers("joints", joints or READY[dof]).cycles(5)
    tape.waypoints(ALL_FRAMES, EVERYTHING, order, 0.001, half_wave(30, *(wave or WAVE[dof]), beside))
    return tape.cycles(cycles).add(request)


# By the robot, for judged_twice(): joints, of which one after the other is left out; the path that is stopped on; twist and
# acceleration of the points; of the lead-in, which takes seconds, where it ends, twist and acceleration there.
LEAD_INS = {
    6: dict(
        path=dict(joints=(127, -127, 70, 127, -127, 127), wave=(0.00133, 0.00156, 0.0022), order=CUBIC),
        twist=(-17, -4, 0, -20, 8, 7), acceleration=(-38, -49, 41, 17, -14, 44), seconds=11.3,
        place=(0.05, 0.03, 0.18), turn=(0, 0.024, -0.263), end=(0, -0.56, 0.4, -0.2, 0.06, 0.7),
        end_acceleration=(0.9, -1.2, -0.7, 0.6, 0.6, -0.2), to_rest=0.6, rest=(-0.2, 0.03, 0)),
    7: dict(
        path=dict(joints=(127, 127, -127, 127, 127, 127, 127), wave=(0.001, 0.0012, 0.0045), beside=(0.002, 0.001, 0.002), cycles=16),
        twist=(-17, -4, 0, -17, 8, 7), acceleration=(-33, -21, 5, -12, -14, 20), seconds=72.49,
        place=(-0.414, -0.025, -0.072), turn=(-0.5, -0.863, -0.186), end=(0, -0.1, -0.034, -0.2, -0.2, 0.2),
        end_acceleration=(0.08, -0.82, 0.24, -0.1, -0.7, -2.2), to_rest=2.25, rest=(0.4, 0.023, -0.1)),
}  # fmt: skip


def judged_twice(path, twist, acceleration, seconds, place, turn, end, end_acceleration, to_rest, rest, cycles):
    """While a dense path is stopped on and joined and joints are at their limits: as many cancels and points as there is
    room for, and a trajectory whose lead-in, bounded, would leave the workspace on every axis. It is refused out of the
    motion, and judged again, to its extrema, from where the arm can be stopped."""
    tape = stopped_while_joining(len(path["joints"]), "pause", **path).cycles(cycles)
    for _ in range(16):
        tape.add("cancel")
    for _ in range(14):
        tape.point(ALL_FRAMES, EVERYTHING, (1, 1, 1, 1, 1, 1) + twist + (2, 2, 2, 2, 2, 2) + REST)
    tape.point(BASE, EVERYTHING, REST + twist + acceleration + (1, 1, 1, 1, 1, 1))
    angle = math.hypot(*turn)
    turned = (math.cos(angle / 2), *(math.sin(angle / 2) / angle * x for x in turn))
    wrench = (5, 4, 3, 2, 1, 1, *REST)
    waypoints = [(seconds, *place, *turned, *end, *end_acceleration, *wrench)]
    waypoints += [(seconds + to_rest, *rest, 1, 0, 0, 0, *REST, *REST, *wrench)]
    return tape.waypoints(ALL_FRAMES, EVERYTHING, QUINTIC, -math.inf, waypoints).cycles(2)


def by_hand(dof):
    tapes = [joined(dof, stream, joins, step) for stream in (0, 1, 13) for joins in (1, 3) for step in (1, 4, 12)]
    signs = (1, -1, 1, -1, 1, -1, 1)
    tapes += [at_limits(dof, turned, v) for turned in (signs, [-s for s in signs]) for v in ((90, 60, -60) * 2, REST)]
    tapes += [judged_twice(**LEAD_INS[dof], cycles=cycles) for cycles in (1, 2, 3)]
    tapes += [stopped_while_joining(dof, request).cycles(40) for request in ("pause", "cancel")]
    return tapes + [all_at_once(dof, corner, twist, step) for corner, twist in CORNERED for step in (1, 12)]


def random_state(rng, tape, dof):
    """Sets random joints, many of them at a limit, and at times velocities and wrench."""
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
    """Returns a random tape, the same for the same seed."""
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
