"""The arm as policies expect it, in the manner of gym and LeRobot: observations and actions are numpy arrays."""

import math
import time
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .arguments import number, real
from .arm import Arm, connect
from .errors import Stopped
from .protocol import Phase
from .streams import Chunks, Stream

_AT_REST = 0.05  # rad/s or m/s
_OBSERVED = ("q", "dq", "tau", "q_d", "dq_d", "pose", "pose_d", "wrench", "margin_s", "stamp_ns")


class Robot:
    """The arm behind a server, for a policy.

        with tactus.Robot("unix:/run/tactus/socket", rate_hz=30) as robot:
            while True:
                robot.act(infer(robot.observe()))

    `connect` and `disconnect` do what entering and leaving the `with` block does; leaving it by an exception brings the
    arm to rest on its path. `arm` is the same connection, for everything else. Errors are those of `Arm` and `Chunks`.
    """

    def __init__(
        self, address: str | None = None, *, rate_hz: float = 30.0, relative_to: str | None = None, **settings: Any
    ):
        """address, settings -- as of `tactus.connect`; rate_hz, relative_to -- as of `Arm.chunks`. Connects to nothing."""
        self._address, self._settings = address, settings
        self._chunks = dict(rate_hz=number("rate_hz", rate_hz, 1e-3, 1e6), relative_to=relative_to)
        self._arm: Arm | None = None
        self._references: Chunks | Stream | None = None
        self._observed_ns: int | None = None

    @property
    def arm(self) -> Arm:
        """The connection; RuntimeError before it is made."""
        if self._arm is None:
            raise RuntimeError("there is no connection; call connect(), or use `with`")
        return self._arm

    def __enter__(self) -> Self:
        self.connect()
        return self

    def __exit__(self, kind: Any, error: Any, trace: Any) -> None:
        try:
            if kind is None:
                self._end()
        finally:
            arm, self._arm, self._references = self._arm, None, None
            if arm is not None:
                arm.__exit__(kind, error, trace)

    def _end(self) -> None:
        """Ends the stream or the chunks of `act`, and raises what the server has refused of them."""
        references, self._references = self._references, None
        if references is not None:
            references.__exit__(None, None, None)

    def connect(self) -> None:
        """Connects to the server. Nothing moves, and another client may own the arm, until the first `act`."""
        if self._arm is not None:
            raise RuntimeError("there is a connection already; disconnect() first")
        self._arm = connect(self._address, **self._settings)

    def disconnect(self) -> None:
        """Gives the lease back and ends the connection; the arm goes on to the last target and rests there."""
        self.__exit__(None, None, None)

    def settle(self) -> None:
        """Waits until the server has reported on all that `act` has sent, and raises what it has refused."""
        if self._references is not None:
            self._references.settle()

    def rest(self, within_s: float = 5.0) -> None:
        """Waits until the arm rests on the last target, or another moves it; after `within_s` cancels what still runs.

        An arm that still moves a second after its reference has come to rest is not waited for.
        """
        if self._references is None:
            return
        self.settle()
        end_s, epoch = time.monotonic() + within_s, self.arm.state().epoch
        held_s = math.inf
        for state in self.arm.watch():
            now_s = time.monotonic()
            if state.epoch != epoch:
                return
            if state.phase == Phase.HOLDING:
                held_s = min(held_s, now_s)
                if np.abs(state.dq).max() < _AT_REST or now_s > held_s + 1.0:
                    return
            elif now_s > end_s:
                self.arm.cancel()
                end_s, epoch = math.inf, self.arm.state().epoch

    def observe(self) -> dict[str, NDArray[Any]]:
        """Returns the latest state; what the pipeline does not have is left out.

        q, dq, tau -- measured, [joints] rad, rad/s, N m; q_d, dq_d -- the reference, which has no tracking error
        pose, pose_d -- of the tip, [7]; wrench -- [6] N, N m
        margin_s   -- until the targets of the last chunk run out
        stamp_ns   -- when it was measured, by time.monotonic_ns(); the next `act` counts its targets from there on
        """
        state = self.arm.state()
        self._observed_ns = state.stamp_ns
        values = {name: getattr(state, name) for name in _OBSERVED}
        return {name: np.asarray(value) for name, value in values.items() if value is not None}

    def act(
        self, action: ArrayLike, *, observed_ns: int | None = None, first: int = 0, ends: bool = False
    ) -> None:
        """Sends a chunk, [n, joints], or one target, [joints]; poses, [n, 7] or [7], if the pipeline takes poses.

        Target k of a chunk is for (first + k) / rate_hz after the latest observation. The time between is measured:
        targets that have passed are trimmed, so do not drop any. One target is for now, whatever `relative_to` is.
        Returns at once; what the server refuses is raised by the next call. After Stopped and `arm.rearm()` go on.
        observed_ns -- time of the observation from which a chunk counts; None: of the latest
        first, ends -- as of `Chunks.send`
        """
        kind = Chunks if real("action", action).ndim > 1 else Stream
        if not isinstance(self._references, kind):
            self._end()
            self._references = self.arm.chunks(**self._chunks) if kind is Chunks else self.arm.stream()
        target: dict[str, Any] = {"q" if self.arm.robot.takes_joints else "pose": action}
        try:
            if isinstance(self._references, Chunks):
                observed_ns = self._observed_ns if observed_ns is None else observed_ns
                self._references.send(**target, observed_ns=observed_ns, first=first, ends=ends)
            else:
                self._references.send(**target, sent_ns=time.monotonic_ns())
        except Stopped:
            self._references = None
            raise
