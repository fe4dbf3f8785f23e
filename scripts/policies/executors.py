"""The executors that the benchmark compares with: what stacks in use do with chunks, each reduced to its idea.

An executor is a function of the chunks in the order of their arrival, the times of the control cycles, the position at
rest at time 0, and the rate of the points. It returns the command of every cycle. None knows a limit, except the
trapezoid.

Two kinds: queues take one step of a chunk per action period; splices keep a plan for all coming cycles and change it
when a chunk arrives. No executor takes a chunk older than the one it has, except `blended`, which is true to its source.
"""

import numpy as np

from splines import clamped_cubic, linear, natural_cubic
from trapezoid import trapezoid

FADE_S, CROSSFADE_S, LEAD_S, PLANT_LAG_S = 1.0, 0.2, 0.010, 0.050
ENSEMBLE = 0.01
VELOCITY, ACCELERATION = 6.28, 22.0  # of the trapezoid, rad/s and rad/s2


def newest_only(chunks):
    """Yields the chunks that are newer than all before."""
    newest = -1
    for chunk in chunks:
        if chunk.number > newest:
            newest = chunk.number
            yield chunk


# Queues.


def actions(chunks, t, start, rate_hz, take):
    """Returns the action of every period: that of its step in the queue, or the last one if the queue lacks it.

    `take(queue, chunk, step, last)` makes the queue, a table of step and target, when a chunk arrives.
    """
    waiting, queue, last, done = list(chunks), {}, start, []
    for step in range(int(t[-1] * rate_hz) + 1):
        while waiting and waiting[0].t_arrival <= step / rate_hz:
            chunk = waiting.pop(0)
            steps = np.round(chunk.t * rate_hz).astype(int)
            queue = take(queue, dict(zip(steps, chunk.q)), step, last, chunk)
        last = queue.get(step, last)
        done.append(last)
    return np.array(done)


def held(points, t, rate_hz):
    """Holds every action for its period."""
    return points[np.floor(t * rate_hz + 1e-9).astype(int)]


def joined(points, t, rate_hz):
    """Goes straight from action to action, one period late."""
    points = np.vstack([points[:1], points])
    s = t * rate_hz + 1e-9
    k = np.floor(s).astype(int)
    return points[k] + (s - k)[:, None] * (points[k + 1] - points[k])


def newest(queue, targets, step, last, chunk):
    return targets


def blend(queue, targets, step, last, chunk):
    """0.3 of the old target and 0.7 of the new; the queue ends where the incoming chunk ends, even an old one."""
    return {k: 0.3 * queue[k] + 0.7 * q if k in queue else q for k, q in targets.items()}


def align(same_step):
    """Shifts the chunk to the action executed last, and fades the shift out.

    As in its source the *next* step becomes the last action; with `same_step` the step of that action does.
    """

    def take(queue, targets, step, last, chunk):
        begin = step - 1 if same_step else step
        offset = last - targets[begin] if begin in targets else 0.0
        ends = FADE_S * 30.0  # steps of its source, 30 Hz
        return {k: q + offset * np.clip(1.0 - (k - step) / ends, 0.0, 1.0) for k, q in targets.items()}

    return take


def ensemble():
    """Averages what all chunks say of a step, with weights exp(-0.01 i) from the oldest on.  [Zhao et al., RSS 2023]"""
    votes = {}

    def take(queue, targets, step, last, chunk):
        for k, q in targets.items():
            votes.setdefault(k, []).append(q)
        weights = np.exp(-ENSEMBLE * np.arange(1 + max(map(len, votes.values()))))
        return {k: weights[: len(votes[k])] @ np.array(votes[k]) / weights[: len(votes[k])].sum() for k in targets}

    return take


def queue_hold(chunks, t, start, rate_hz):
    return held(actions(newest_only(chunks), t, start, rate_hz, newest), t, rate_hz)


def queue_linear(chunks, t, start, rate_hz):
    return joined(actions(newest_only(chunks), t, start, rate_hz, newest), t, rate_hz)


def blended(chunks, t, start, rate_hz):
    return joined(actions(chunks, t, start, rate_hz, blend), t, rate_hz)


def aligned(chunks, t, start, rate_hz):
    return joined(actions(newest_only(chunks), t, start, rate_hz, align(False)), t, rate_hz)


def aligned_trapezoid(chunks, t, start, rate_hz):
    return trapezoid(aligned(chunks, t, start, rate_hz), t[1] - t[0], VELOCITY, ACCELERATION)


def realigned_trapezoid(chunks, t, start, rate_hz):
    points = actions(newest_only(chunks), t, start, rate_hz, align(True))
    return trapezoid(joined(points, t, rate_hz), t[1] - t[0], VELOCITY, ACCELERATION)


def act_ensemble(chunks, t, start, rate_hz):
    return joined(actions(newest_only(chunks), t, start, rate_hz, ensemble()), t, rate_hz)


def fast_then_hold(chunks, t, start, rate_hz):
    """Twenty targets a second, each the step that is due; the way there takes 0.3 of the period."""
    period, share = 0.05, 0.3
    newest_chunks, waiting = None, list(newest_only(chunks))
    goals = [start]
    for k in range(int(t[-1] / period) + 1):
        while waiting and waiting[0].t_arrival <= k * period:
            newest_chunks = waiting.pop(0)
        due = -1 if newest_chunks is None else np.searchsorted(newest_chunks.t, k * period, "right") - 1
        goals.append(goals[-1] if due < 0 else newest_chunks.q[due])
    goals, k = np.array(goals), np.floor(t / period + 1e-9).astype(int)
    way = np.clip((t - k * period) / (share * period), 0.0, 1.0)[:, None]
    return goals[k] + way * (goals[k + 1] - goals[k])


# Splices.


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
        s = np.clip((t[i:] - t[i]) / CROSSFADE_S, 0.0, 1.0)[:, None]
        weight = s**3 * (10.0 - 15.0 * s + 6.0 * s**2)
        plan[i:] = old + weight * (plan[i:] - old)

    return splice(chunks, t, start, join)


def to_rest(stamps, q, v0):
    return clamped_cubic(stamps, q, v0, np.zeros(q.shape[1]))


def onward(stamps, q, v0):
    """The end keeps the velocity of the last two points."""
    last = (q[-1] - q[-2]) / (stamps[-1] - stamps[-2])
    return clamped_cubic(stamps, q, v0, last if len(q) > 2 else np.zeros(q.shape[1]))


EXECUTORS = {
    "queue, held": queue_hold,
    "queue, linear": queue_linear,
    "0.3/0.7, linear": blended,
    "align and fade": aligned,
    "same, trapezoid": aligned_trapezoid,
    "same step, trapezoid": realigned_trapezoid,
    "ACT ensemble": act_ensemble,
    "20 Hz, 0.3 of it": fast_then_hold,
    "linear splice": continued(commanded, linear),
    "cubic from measured": continued(measured, to_rest),
    "cubic from commanded p": continued(commanded, to_rest),
    "cubic from p and v": continued(commanded_moving, onward),
    "cubic, crossfade": crossfaded,
}
