"""Streams of references that follow each other: points, velocities, and chunks as policies give them."""

import collections
import time
import warnings
from typing import Any, Mapping, Self

import numpy as np
from numpy.typing import ArrayLike

from . import tactus_pb2 as pb
from .arguments import TASK_WIDTHS, Targets, flag, member, milliseconds, number, whole
from .connection import Call, Session
from .errors import Stopped
from .protocol import Outcome

_UNREPORTED = 12  # references of a stream that wait for their reports; the server has space for 16 requests
_MOST_CHANNELS = 8  # of a chunk; gateway/tactus.options


class References:
    """References that follow each other, each with its place in the stream, and what has become of them."""

    def __init__(self, session: Session, targets: Targets):
        self._session, self._targets = session, targets
        self._epoch: int | None = None
        self._calls: collections.deque[Call] = collections.deque()

    def _open(self) -> Self:
        """Takes the lease and the present epoch, if it has not yet."""
        if self._epoch is None:
            self._epoch = self._session.own()
        return self

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: Any, error: Any, trace: Any) -> None:
        if kind is None:
            self.settle()
        elif self._epoch is not None:
            self._session.cancel()

    def settle(self) -> None:
        """Waits until the server has reported on all that was sent, and raises what it has refused."""
        self._collect(0)

    def _send(self, kind: str, request: Any) -> None:
        self._open()
        self._collect(_UNREPORTED)
        if self._session.epoch != self._epoch:
            raise Stopped("the arm was stopped since this stream was opened; rearm and open a new stream to go on")
        request.terms.CopyFrom(self._targets.terms)
        with self._session.news:
            self._session.sequence += 1
            request.place.epoch, request.place.sequence = self._epoch, self._session.sequence
        self._calls.append(self._session.send(kind, request))

    def _collect(self, most: int) -> None:
        """Takes the reports that have come, waits until at most `most` are missing, and raises the first refusal."""
        while self._calls and (self._calls[0].final or len(self._calls) > most):
            call = self._calls.popleft()
            self._session.wait(lambda: call.final, f"report on {call.kind}")
            self._judge(call)

    def _judge(self, call: Call) -> None:
        if refusal := call.refusal():
            if self._session.epoch != self._epoch:
                raise Stopped(str(refusal)) from refusal
            raise refusal
        if call.report is not None and Outcome(call.report.outcome) in (Outcome.ABORTED, Outcome.CANCELED):
            raise Stopped(call.report.text or "the motion of this stream was canceled; open a new stream to go on")


class Stream(References):
    """A stream of points or velocities at any rate (`Arm.stream`). The newest wins; the server keeps the limits.

    A `send` does not wait for the server; what it refuses is raised by the next `send`, or at the end of the `with`
    block: Refused, or Stopped if a stop has made the stream void. Leaving the block by an exception cancels the
    motion; otherwise the arm goes to the last point.
    """

    def send(
        self,
        *,
        q: ArrayLike | None = None,
        dq: ArrayLike | None = None,
        ddq: ArrayLike | None = None,
        tau: ArrayLike | None = None,
        pose: ArrayLike | None = None,
        twist: ArrayLike | None = None,
        acceleration: ArrayLike | None = None,
        wrench: ArrayLike | None = None,
        outputs: Mapping[int, bool] | None = None,
        sent_ns: int = 0,
    ) -> None:
        """Sends a point: q and what goes with it, [joints], or pose and what goes with it, [7] and [6].

        With dq or twist the arm passes the point at that velocity and comes to rest if no other follows.
        outputs -- digital outputs, set when the point takes effect; the others are left alone
        sent_ns -- when the device was read, by any clock that does not step, `time.monotonic_ns()` for example: the arm
            follows the stream smoothly although some of its points come late or not at all
        """
        joint, tip = dict(q=q, dq=dq, ddq=ddq, tau=tau), dict(pose=pose, twist=twist, acceleration=acceleration)
        targets = self._targets.read((), **joint, **tip, wrench=wrench)
        point = pb.Point(sent_ns=whole("sent_ns", sent_ns, -(2**63), 2**63 - 1))
        for output, on in self._targets.outputs(outputs).items():
            point.outputs_mask |= 1 << output
            point.outputs |= int(on) << output
        for name, numbers in targets.items():
            getattr(point.task if name in TASK_WIDTHS else point.joint, name).extend(numbers.tolist())
        self._send("point", point)

    def velocity(self, *, dq: ArrayLike | None = None, twist: ArrayLike | None = None, timeout_s: float = 0.2) -> None:
        """Sends velocities of the joints, [joints] rad/s, or of the tip, [6] m/s and rad/s, to keep until the next.

        timeout_s -- 0.001 to 10: if nothing follows for as long, the arm comes to rest
        """
        if (dq is None) == (twist is None):
            raise ValueError("give either dq or twist")
        request = pb.Velocity(timeout_ms=milliseconds("timeout_s", timeout_s, 0.001, 10))
        if dq is not None:
            request.dq.extend(self._targets.field("dq", dq).tolist())
        if twist is not None:
            request.twist.extend(self._targets.field("twist", twist).tolist())
        self._send("velocity", request)


class Chunks(References):
    """Chunks of future targets (`Arm.chunks`). Each replaces the plan from its first target ahead on, smoothly.

    A chunk that is late as a whole is no error: `late` counts them, `late_s` is by how much the newest of them came
    after its last target, and the old plan goes on. If all of a second are late, there is a warning. The arm comes to
    rest when the targets run out, unless a new chunk comes before. Errors are raised as by a `Stream`.
    """

    def __init__(
        self, session: Session, targets: Targets, rate_hz: float, base: str | None, crossfade_s: float, lead_s: float
    ):
        super().__init__(session, targets)
        self._base = member("relative_to", "none" if base is None else base, pb.Chunk.Base)
        self._rate_hz = number("rate_hz", rate_hz, 1e-3, 1e6)
        self._crossfade_s = number("crossfade_s", crossfade_s, 0, 0.3)
        self._outputs_lead_s = number("outputs_lead_s", lead_s, -0.5, 0.5)
        self.late, self.late_s = 0, 0.0
        self._late_since: float | None = None

    def send(
        self,
        q: ArrayLike | None = None,
        *,
        pose: ArrayLike | None = None,
        dq: ArrayLike | None = None,
        twist: ArrayLike | None = None,
        observed_ns: int | None = None,
        first: int = 0,
        ends: bool = False,
        outputs: Mapping[int, ArrayLike] | None = None,
    ) -> None:
        """Sends a chunk; target k is for the time observed_ns + (first + k) / rate_hz.

        q, dq       -- [n, joints] rad and rad/s, or
        pose, twist -- [n, 7] and [n, 6] of the tip; dq and twist are optional
        observed_ns -- when the observation was made, by time.monotonic_ns(); of a State, its stamp_ns. None: times
                       count from the arrival at the server (for devices; a policy loses its latency)
        first       -- number of the first target; 0: that of the observation itself
        ends        -- the last target is reached at rest, and no chunk follows
        outputs     -- digital outputs, at most 8, each with [n] values: {0: closed}; the others are left alone
        """
        targets = self._targets.read((None,), q=q, dq=dq, pose=pose, twist=twist)
        count, longest = len(next(iter(targets.values()))), self._session.robot.longest_chunk
        if count > longest:
            raise ValueError(f"{count} targets; the server takes {longest} in a chunk")
        if observed_ns is None and self._base != pb.Chunk.NONE:
            raise ValueError("observed_ns is missing; relative targets count from the state at an observation")
        first = number("first", first, -1e6, 1e6)
        chunk = pb.Chunk(
            base=self._base,
            ends=flag("ends", ends),
            crossfade_s=self._crossfade_s,
            time_s=((first + np.arange(count)) / self._rate_hz).tolist(),
            time=pb.Chunk.ON_ARRIVAL if observed_ns is None else pb.Chunk.ABSOLUTE,
            outputs_lead_s=self._outputs_lead_s,
        )
        for output, values in self._targets.outputs(outputs, (count,)).items():
            chunk.channels.add(output=output, values=values.tolist())
        if len(chunk.channels) > _MOST_CHANNELS:
            raise ValueError(f"outputs: {len(chunk.channels)} of them; at most {_MOST_CHANNELS} are taken in a chunk")
        if observed_ns is not None:
            chunk.origin_ns = chunk.observed_ns = self._session.server_stamp("observed_ns", observed_ns)
        for name, numbers in targets.items():
            getattr(chunk, name).extend(numbers.ravel().tolist())
        self._send("chunk", chunk)

    def _judge(self, call: Call) -> None:
        refusal = call.refusal()
        if refusal is None or refusal.status != pb.CODE_CHUNK_LATE:
            self._late_since = None
            if refusal:
                super()._judge(call)
            return
        self.late, self.late_s = self.late + 1, refusal.value or 0.0
        now = time.monotonic()
        self._late_since = self._late_since or now
        if now - self._late_since > 1:
            warnings.warn(
                f"every chunk of the last second came too late, the newest {self.late_s:.3f} s after its last target: "
                "infer faster, predict more targets, or give observed_ns by time.monotonic_ns()",
                stacklevel=4,
            )
            self._late_since = now
