"""Real-time chunking: a policy makes every chunk as a continuation of the one that is being executed.

[Black, Galliker, Levine, "Real-Time Execution of Action Chunking Flow Policies", arXiv:2506.07339, 2025]

The policy is handed the targets that are still to be executed, and the delay: the longest inference so far, in steps.
Guidance draws its chunk towards those targets, with a weight of 1 for the steps of the delay, which will have been
executed before the chunk arrives, and less for the later ones. There is no policy here to guide: the average of the two
chunks by these weights stands for the guided one.
"""

import dataclasses

import numpy as np

from newest_only import newest_only
from queues import hold
from splines import linear

HORIZON = 10  # steps, the default of LeRobot


def falling(delay, end, count):
    """Returns the weight of every step: 1 for those of the delay, then falling linearly to 0 at the step `end`."""
    return np.clip((end - np.arange(count)) / (end - min(delay, end) + 1), 0.0, 1.0)


def lerobot(delay, left, count):
    """The weights of LeRobot; if fewer targets are left, the last one counts for the others."""
    return falling(delay, HORIZON, count)


def published(delay, left, count):
    """The weights of the paper, for all targets that are left."""
    share = falling(delay, left, count)
    return share * np.expm1(share) / np.expm1(1.0)


def conditioned(chunks, rate_hz, weights, queued=False):
    """Yields the chunks that are newer than all before, drawn towards the one that was executed at the observation.

    With `queued`, the times are those of an executor that takes actions from a queue. Of a new chunk it skips as many
    as it has executed since the observation; it executes the chunk late if the queue was empty meanwhile.
    """
    made, longest_s = [], 0.0
    for chunk in newest_only(chunks):
        t, q = chunk.t, chunk.q
        before = next((one for one in reversed(made) if one.t_arrival <= chunk.t_obs), None)
        left = 0 if before is None else int(np.sum(before.t > chunk.t_obs - 0.5 / rate_hz))
        if left:
            weight = weights(int(np.ceil(longest_s * rate_hz)), left, len(q))[:, None]
            q = weight * linear(before.t, before.q, None)(t) + (1.0 - weight) * q
        if made:  # the first inference is not counted: it warms up
            longest_s = max(longest_s, chunk.t_arrival - chunk.t_obs)
        if queued:
            empty_s = max(chunk.t_obs, made[-1].t[-1] + 1.0 / rate_hz) if made else chunk.t_obs
            t = t + max(np.ceil((chunk.t_arrival - empty_s) * rate_hz), 0.0) / rate_hz
        made.append(dataclasses.replace(chunk, t=t, q=q))
        yield made[-1]


def held(chunks, t, start, rate_hz):
    return hold(conditioned(chunks, rate_hz, lerobot, queued=True), t, start, rate_hz)
