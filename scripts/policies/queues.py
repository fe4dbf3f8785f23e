"""Executors that keep a queue and take one step of it per action period.

Steps are those of the robot's clock. None takes a chunk older than the one it has, except `blended`, which is true to
its source.
"""

import numpy as np

from newest_only import newest_only
from trapezoid import trapezoid

FADE_S = 1.0
ENSEMBLE = 0.01
VELOCITY, ACCELERATION = 6.28, 22.0  # of the trapezoid, rad/s and rad/s2


def actions(chunks, t, start, rate_hz, take):
    """Returns the action of every period: that of its step in the queue, or the last one if the queue lacks it.

    `take(queue, targets, step, last, chunk)` returns the queue, a table of targets by step, when a chunk arrives before
    `step`; `last` is the action executed last.
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
        ends = FADE_S * 30.0  # steps, at the 30 Hz of its source
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


def hold(chunks, t, start, rate_hz):
    return held(actions(newest_only(chunks), t, start, rate_hz, newest), t, rate_hz)


def go_straight(chunks, t, start, rate_hz):
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
