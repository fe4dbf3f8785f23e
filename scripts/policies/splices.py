"""Executors that keep a plan for all coming cycles, and change it when a chunk arrives that is newer than the last."""

import numpy as np

from newest_only import newest_only
from signals import minimum_jerk
from splines import clamped_cubic, linear, natural_cubic

CROSSFADE_S, LEAD_S, PLANT_LAG_S = 0.2, 0.010, 0.050


def splice(chunks, t, start, join):
    """Returns the plan that `join(plan, i, chunk)` changes from cycle i on, when the chunk arrives."""
    plan = np.tile(start, (len(t), 1)).astype(float)
    for chunk in newest_only(chunks):
        i = int(np.searchsorted(t, chunk.t_arrival))
        if i < len(t):
            join(plan, i, chunk)
    return plan


def put(plan, t, i, curve, end):
    """Sets the plan to the curve from cycle i up to the time `end`, and holds it there."""
    last = min(int(np.searchsorted(t, end, "right")), len(t))
    if last > i:
        plan[i:last] = curve(t[i:last])
        plan[last:] = curve(np.array([end]))


def ahead(chunk, now):
    """Returns the points that are ahead by at least the lead."""
    keep = chunk.t > now + LEAD_S
    return chunk.t[keep], chunk.q[keep]


def velocity(plan, i, dt):
    return (plan[i - 1] - plan[i - 2]) / dt if i >= 2 else np.zeros(plan.shape[1])


def continued(start_of, interpolate):
    """Returns the splice that goes on from start_of(plan, i, dt) through the points of the chunk that are ahead."""

    def executor(chunks, t, start, rate_hz):
        dt = t[1] - t[0]

        def join(plan, i, chunk):
            stamps, q = ahead(chunk, t[i])
            if len(stamps) == 0:
                return
            q0, v0 = start_of(plan, i, dt)
            begin = t[max(i - 1, 0)]
            put(plan, t, i, interpolate(np.r_[begin, stamps], np.vstack([q0, q]), v0), stamps[-1])

        return splice(chunks, t, start, join)

    return executor


def commanded(plan, i, dt):
    return plan[max(i - 1, 0)], np.zeros(plan.shape[1])


def commanded_moving(plan, i, dt):
    return plan[max(i - 1, 0)], velocity(plan, i, dt)


def measured(plan, i, dt):
    return plan[max(i - 1 - int(round(PLANT_LAG_S / dt)), 0)], np.zeros(plan.shape[1])


def crossfaded(chunks, t, start, rate_hz):
    """Goes over from the old plan to the cubic through all points of the chunk, by a quintic weight."""

    def join(plan, i, chunk):
        if chunk.t[-1] <= t[i]:
            return
        old = plan[i:].copy()
        put(plan, t, i, natural_cubic(chunk.t, chunk.q), chunk.t[-1])
        weight = minimum_jerk((t[i:] - t[i]) / CROSSFADE_S)[:, None]
        plan[i:] = old + weight * (plan[i:] - old)

    return splice(chunks, t, start, join)


def to_rest(stamps, q, v0):
    return clamped_cubic(stamps, q, v0, np.zeros(q.shape[1]))


def onward(stamps, q, v0):
    """The end keeps the velocity of the last two points."""
    last = (q[-1] - q[-2]) / (stamps[-1] - stamps[-2])
    return clamped_cubic(stamps, q, v0, last if len(q) > 2 else np.zeros(q.shape[1]))


linear_splice = continued(commanded, linear)
cubic_from_measured = continued(measured, to_rest)
cubic_from_commanded = continued(commanded, to_rest)
cubic_from_moving = continued(commanded_moving, onward)
