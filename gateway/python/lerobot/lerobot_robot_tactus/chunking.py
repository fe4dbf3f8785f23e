"""Real-time chunking on the server's plan: what a policy is conditioned on, from stamps of the arm.

[Black, Galliker, Levine, "Real-Time Execution of Action Chunking Flow Policies", arXiv:2506.07339, 2025]

LeRobot's queue sends one action per step, and its delay is the longest inference of this process. Here the server has
the whole chunk, and counts the targets that had passed when the next one took effect.
"""

import collections
import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from .robot import TactusRobot


class RealTimeChunking:
    """Hands a policy what is left of the last chunk, and the server its next chunk on the same steps.

        chunking = RealTimeChunking(robot)
        while True:
            observation = robot.get_observation()
            actions = policy.predict_action_chunk(batch(observation), **chunking.condition())[0]
            chunking.send(postprocess(actions), actions)

    After an error of `tactus`, a stop for example, begin with a new one.
    """

    def __init__(self, robot: TactusRobot, window: int = 10):
        """window -- inferences of which the longest counts as the delay"""
        self._robot, self._step_ns = robot, 1e9 / robot.config.rate_hz
        self._delays: collections.deque[int] = collections.deque(maxlen=window)
        self._plan: tuple[float, Any, int] = (0.0, (), 0)  # time of the first target, actions, how many are not in force
        self._sent: tuple[float, Any] | None = None  # time and actions of a chunk on which there is no report yet
        self.first_ns = 0.0  # time of row 0 of the next chunk, by time.monotonic_ns()
        self._trimmed = self._late = 0  # as the server has counted before the next chunk

    def condition(self) -> dict[str, Any]:
        """Returns the keywords of `predict_action_chunk`, for the latest observation of the robot.

        prev_chunk_left_over -- actions in force, from the first step at or after the observation on; None: there are none
        inference_delay      -- how many of them are committed, because they are executed before the next chunk comes:
                                the most targets of one of the last chunks that had passed when it took effect
        """
        self._take_report()
        seen_ns, (first_ns, actions, trimmed) = self._robot.observed_ns, self._plan
        passed = max(trimmed, math.ceil((seen_ns - first_ns) / self._step_ns))
        left = actions[passed:]
        if not len(left):
            self.first_ns = seen_ns
            return dict(inference_delay=0, prev_chunk_left_over=None)
        self.first_ns = first_ns + passed * self._step_ns
        return dict(inference_delay=min(max(self._delays), len(left)), prev_chunk_left_over=left)

    def send(self, targets: ArrayLike, actions: Any = None) -> None:
        """Sends a chunk: its row 0 is for the same step as that of `prev_chunk_left_over`, and all of it is sent.

        targets -- [n, joints] rad
        actions -- the same as the policy gave them, n rows to be handed back; None: the targets
        """
        targets = np.array(targets, float)
        if targets.ndim != 2 or (actions is not None and len(actions) != len(targets)):
            raise ValueError(f"targets {targets.shape} of {'no' if actions is None else len(actions)} actions; expected [n, joints], n alike")
        with self._robot.connection() as robot:
            robot.act(targets, observed_ns=round(self.first_ns))
        self._sent = self.first_ns, targets if actions is None else actions

    def _take_report(self) -> None:
        """Waits for the report on the last chunk. One that came too late as a whole is not in force."""
        with self._robot.connection() as robot:
            robot.settle()
            state = robot.arm.state()
        if self._sent is not None:
            trimmed = state.targets_trimmed - self._trimmed
            if state.chunks_late == self._late:
                self._plan = *self._sent, trimmed
            else:
                trimmed = len(self._sent[1])
            self._delays.append(trimmed)
        self._sent, self._trimmed, self._late = None, state.targets_trimmed, state.chunks_late
