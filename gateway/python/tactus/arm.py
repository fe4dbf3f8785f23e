"""The arm behind a server, and the connection to it."""

import contextlib
import os
import pathlib
import sys
import time
from typing import Any, Iterator, Mapping, Self, Sequence

import numpy as np
from numpy.typing import ArrayLike

from . import parameters, tactus_pb2 as pb
from .arguments import Path, Targets, flag, member, milliseconds, number, real, text, whole
from .connection import Session
from .errors import Error, Lost, Refused
from .messages import Event, Result, State, state_of
from .parameters import Parameter
from .protocol import LONGEST_WAIT_S, Array
from .streams import Chunks, Stream
from .trajectories import Motion


class Arm:
    """The arm behind a server (`connect`). The first motion takes the lease; the end of the `with` block returns it.

    Leaving it by an exception, Ctrl-C among them, cancels what runs: the arm comes to rest on its path. Leaving it
    otherwise lets a trajectory that was begun by `start` run to its end, and waits until all its waypoints are sent.
    Every method raises Lost if the connection has ended; those that move the arm raise Refused if another client owns
    it, with its name.
    """

    def __init__(self, session: Session):
        self._session = session
        self.address = session.address
        self.robot = session.robot

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: Any, error: Any, trace: Any) -> None:
        session = self._session
        try:
            if kind is not None and session.leased:
                session.cancel()
            elif session.uploader is not None and session.uploader.ident:
                session.uploader.join()
            with contextlib.suppress(Error):
                session.release()
        finally:
            session.close()

    def close(self) -> None:
        """Gives the lease back and ends the connection, as leaving the `with` block does."""
        self.__exit__(None, None, None)

    # What it does

    def state(self) -> State:
        """Returns the latest State, at most about `state_s` old, and newer than every result and control so far."""
        told = self._session.wait(self._session.present_state, "State")
        if self._session.broken:
            raise self._session.broken
        return state_of(told, self._session.clock)

    def watch(self) -> Iterator[State]:
        """Yields States as they come, until the connection ends; who is too slow sees the latest only."""
        seen = None
        while True:
            seen = self._session.wait(lambda: self._session.state if self._session.state is not seen else None, "State")
            yield state_of(seen, self._session.clock)

    def events(self) -> list[Event]:
        """Returns the events since the last call, the latest 1024 at most."""
        with self._session.news:
            events = list(self._session.events)
            self._session.events.clear()
        return events

    @property
    def starved(self) -> int:
        """How often the arm came to rest because no chunk or velocity followed in time."""
        return self._session.starved

    @property
    def clock_uncertainty_ns(self) -> float:
        """By how much a stamp may be wrong: half of the shortest round trip."""
        return self._session.clock.uncertainty_ns

    # Motion

    def move(self, **trajectory: Any) -> Result:
        """Executes a trajectory and returns when it has ended. Takes what `start` takes, raises what `wait` does."""
        return self.start(**trajectory).wait()

    def start(
        self,
        *,
        t: ArrayLike,
        q: ArrayLike | None = None,
        dq: ArrayLike | None = None,
        ddq: ArrayLike | None = None,
        tau: ArrayLike | None = None,
        pose: ArrayLike | None = None,
        twist: ArrayLike | None = None,
        acceleration: ArrayLike | None = None,
        wrench: ArrayLike | None = None,
        joints: Sequence[str] | None = None,
        interpolation: str = "by_fields",
        wrap: str = "as_given",
        exact: bool = False,
        start_ns: int | None = None,
        motion_frame: str = "",
        wrench_frame: str = "",
        window: int = 0,
        check: bool = False,
    ) -> Motion:
        """Begins a trajectory of any length and returns it as soon as the server has accepted it.

        t             -- [n] s, increasing, from 0 or later; time 0 is when it begins
        q, dq, ddq, tau -- [n, joints] of the joints, or
        pose, twist, acceleration, wrench -- [n, 7], [n, 6], [n, 6], [n, 6] of the tip; all but q or pose are optional
        joints        -- names of the joints that the columns are of; the others hold. None: all
        interpolation -- by_fields, linear, cubic, quintic, monotone (docs/reference-generators.md)
        wrap          -- nearest: each angle of a joint without end (robot.joints[i].continuous) is the nearest to the
                         one before, the first to the reference, that differs by whole turns; as_given
        exact         -- refuse what is too fast instead of slowing it down
        start_ns      -- when it begins, by time.monotonic_ns(); None: at once
        motion_frame, wrench_frame -- an output of the pipeline, "block.port"; "": the base
        window        -- waypoints that are in the server at once; 0: all that it has space for (robot.window)
        check         -- judge it and move nothing

        What the server holds at once is judged before the arm moves; the rest is sent while it moves.
        Raises Refused with waypoint, joint, value and limit if the server does not accept it.
        """
        joint, tip = dict(q=q, dq=dq, ddq=ddq, tau=tau), dict(pose=pose, twist=twist, acceleration=acceleration)
        targets = Targets(self.robot, joints, motion_frame, wrench_frame)
        given = targets.read((None,), **joint, **tip, wrench=wrench)
        numbers, times = np.hstack(list(given.values())), real("t", t).astype(float)
        if times.shape != numbers.shape[:1]:
            raise ValueError(f"t has the shape {times.shape}; give one time for each of the {len(numbers)} waypoints")
        begin = pb.Begin(
            terms=targets.terms,
            wrap=member("wrap", wrap, pb.Begin.Wrap),
            interpolation=member("interpolation", interpolation, pb.Begin.Interpolation),
            exact=flag("exact", exact),
            start_ns=0 if start_ns is None else self._session.server_stamp("start_ns", start_ns),
            poses="pose" in given,
            velocities="dq" in given or "twist" in given,
            accelerations="ddq" in given or "acceleration" in given,
            efforts="tau" in given or "wrench" in given,
            check=flag("check", check),
            window=whole("window", window, 0, 2**32 - 1),
        )
        if begin.wrap != pb.Begin.AS_GIVEN and not any(one.continuous for one in self.robot.joints):
            raise ValueError(f"wrap {wrap!r}: every joint of {self.robot.name} has stops; leave it out")
        if not check:
            self._session.own()
        return Motion(self._session, begin, times, numbers)

    def check(self, **trajectory: Any) -> Result:
        """Has the server judge the limits of a trajectory, and moves nothing; needs no lease.

        The outcome is EXECUTED, and `stretch` how much it would be slowed down. Raises Refused with the reason.
        """
        return self.start(check=True, **trajectory).wait()

    def point(self, **target: Any) -> None:
        """Sends one point (what `Stream.send` takes) and returns when it is in force. A trajectory is aborted."""
        with Stream(self._session, Targets(self.robot)) as stream:
            stream.send(**target)

    def velocity(self, **target: Any) -> None:
        """Sends one velocity (what `Stream.velocity` takes) and returns when it is in force."""
        with Stream(self._session, Targets(self.robot)) as stream:
            stream.velocity(**target)

    def stream(self, *, motion_frame: str = "", wrench_frame: str = "", joints: Sequence[str] | None = None) -> Stream:
        """Returns a stream of points or velocities at any rate; use it in a `with` statement.

        motion_frame, wrench_frame, joints -- as of `start`, for all that is sent
        """
        return Stream(self._session, Targets(self.robot, joints, motion_frame, wrench_frame))._open()

    def chunks(
        self,
        *,
        rate_hz: float,
        relative_to: str | None = None,
        crossfade_s: float = 0.2,
        outputs_lead_s: float = 0.0,
        motion_frame: str = "",
        joints: Sequence[str] | None = None,
    ) -> Chunks:
        """Returns a stream of chunks of future targets, as policies give them; use it in a `with` statement.

        rate_hz     -- of the targets within a chunk, 0.001 to 1 000 000
        relative_to -- None: targets are absolute; "commanded": they are added to the reference that the arm had at the
                       time of the observation; "measured": to where the arm was then
        crossfade_s -- 0 to 0.3, in which the difference to the old plan fades, or longer by the limits. 0: as fast
                       as they allow
        outputs_lead_s -- -0.5 to 0.5: by how much digital outputs change before their targets are reached (the latency
                       of a gripper); negative: after they have been passed (the lag of the arm)
        motion_frame, joints -- as of `start`

        Raises Refused if the pipeline takes no chunks.
        """
        if not self.robot.longest_chunk:
            raise Refused(f"the pipeline {self.robot.pipeline} takes no chunks", 0)
        targets = Targets(self.robot, joints, motion_frame)
        return Chunks(self._session, targets, rate_hz, relative_to, crossfade_s, outputs_lead_s)._open()

    # Controls

    def cancel(self) -> None:
        """Ends what runs, whoever moves it; the arm brakes on its path and holds. Refused (42) if nothing runs."""
        self._session.ask("cancel", pb.Cancel())

    def override(self, rate: float) -> None:
        """Lets trajectories pass at this fraction of their speed, 0 to 1, from now on. To raise it needs the lease."""
        request = pb.Override(rate=number("rate", rate, 0, 1), stops=self._session.stops)
        try:
            self._session.ask("override", request)
        except Refused as refusal:
            if refusal.status != pb.CODE_NOT_OWNER:
                raise
            self._session.own()
            self._session.ask("override", request)

    def pause(self) -> None:
        """Brings the arm to rest on its path, whoever moves it; the trajectory lives until `resume` or `cancel`."""
        self._session.ask("pause", pb.Pause())

    def resume(self) -> None:
        """Ends a pause."""
        request = pb.Resume(stops=self._session.stops)
        self._session.own()
        self._session.ask("resume", request)

    def stop(self) -> None:
        """Stops the whole chain, whoever moves it; needs no lease. The arm moves again only after `rearm`."""
        self._session.ask("stop", pb.Stop())

    def rearm(self, within_s: float = 5.0) -> None:
        """Takes over the arm after a stop or a fault, where it is, and returns when it can be moved.

        Waits for `within_s`, 0 to 86 400, until the arm is at rest; otherwise raises Refused with the reason, at once.
        Waits for as long as arming takes (`[executive] arming_ms`). What was sent before is void.
        """
        end = time.monotonic() + number("within_s", within_s, 0, LONGEST_WAIT_S)
        request = pb.Rearm(stops=self._session.stops)
        while True:
            self._session.own()
            try:
                self._session.ask("rearm", request, lasts=True)
                break
            except Refused as refusal:
                if refusal.status != pb.CODE_NOT_AT_REST or time.monotonic() > end:
                    raise
            time.sleep(0.02)
        self._await_nominal(max(1.0, end - time.monotonic()))

    def tare(self) -> Array:
        """Takes a new zero of the force/torque sensor while the arm is controlled, and returns it when it holds.

        Let the arm rest, with nothing in contact. Raises Refused, and the old zero stays, if the zero would move too
        far, which may be a contact (115), if the sensor is not steady in time (75), or if the arm is stopped.
        Returns force and moment at the flange, in its axes: N, N m. Waits for as long as the pipeline gives a tare.
        """
        self._session.own()
        report = self._session.ask("tare", pb.Tare(), lasts=True).report
        if report is None or len(report.zero) != 6:
            raise Lost(f"{self.address}: the server has reported a tare without its zero")
        return np.array(report.zero)

    def parameters(self) -> list[Parameter]:
        """The parameters of the pipeline: present values, units, ranges, and which may change now. Needs no lease."""
        return parameters.listed(self._session)

    def set_parameters(self, values: Mapping[str, Mapping[str, Any]], *, check: bool = False) -> None:
        """Changes parameters of the pipeline, all in one cycle or none: {"pd": {"kp": [100, 100, ...]}}.

        No command steps. Returns when they are in force. Raises Refused with section, key and reason.
        values -- at most 32; texts, or numbers that take at most 191 bytes as such
        check  -- judge them and change nothing; needs no lease
        """
        request = parameters.request_of(values)
        request.check = flag("check", check)
        if not check:
            self._session.own()
        self._session.ask("parameters", request)

    def release(self) -> None:
        """Gives the lease back, if this client has it; what runs goes on to its end."""
        self._session.release()

    def _await_nominal(self, within_s: float) -> None:
        """Waits until the arm is armed and can be moved; raises Error if it is not within that time."""
        session, before = self._session, self._session.state

        def told(state: pb.State | None) -> bool:
            return state is not None and state is not before and state.rung <= pb.RUNG_SKIP_OPTIONAL

        with contextlib.suppress(TimeoutError):
            session.wait_long(lambda: told(session.state), "armed arm", within_s)
            return
        state = self.state()
        raise Error(f"the arm is not armed within {within_s:.3g} s; {state.rung!r}, {state.status!r}")


def connect(
    address: str | None = None,
    *,
    key: Path | None = None,
    name: str | None = None,
    priority: int = 0,
    lease_s: float = 1.0,
    state_s: float = 0.01,
    feedback_s: float = 0.02,
    timeout_s: float = 2.0,
) -> Arm:
    """Connects to a server and returns its arm; use it in a `with` statement.

    address    -- "unix:/path/of/the/socket" or "tcp:HOST:PORT"; None: the socket on which this user's `tactus serve`
                  listens
    key        -- file with the key of a server on the network, as `openssl rand -hex 32` makes it; encrypts everything
    name       -- by which others see who moves the arm; without it, program and process number
    priority   -- of the lease, 0 to 255: who has a higher one takes the arm away
    lease_s    -- the arm stops on its path when nothing has come from this process for as long; 0.02 to 60
    state_s    -- between two States, whole milliseconds; 0.001 to timeout_s
    feedback_s -- between two Feedbacks of a trajectory, whole milliseconds; to 60; 0: none
    timeout_s  -- a server that does not answer or is silent for as long has failed; 0.01 to 86 400

    Nothing moves and no lease is asked for before the first motion. Raises Lost if there is no such server, Refused if
    it does not take this client.
    """
    if name is None:
        program = pathlib.Path(sys.argv[0]).name or "python"
        name = f"{program}.{os.getpid()}".encode(errors="replace").decode()
    if address is None:
        folder = os.environ.get("XDG_RUNTIME_DIR", "")
        address = f"unix:{folder}/tactus.sock" if folder.startswith("/") else f"unix:/tmp/tactus-{os.getuid()}.sock"
    timeout_s = number("timeout_s", timeout_s, 0.01, LONGEST_WAIT_S)
    lease = pb.Lease(wish=pb.Lease.TAKE, priority=whole("priority", priority, 0, 255))
    lease.timeout_ms = milliseconds("lease_s", lease_s, 0.02, 60)
    subscription = pb.Subscribe(events=True, state_ms=milliseconds("state_s", state_s, 0.001, timeout_s))
    subscription.feedback_ms = milliseconds("feedback_s", feedback_s, 0, 60)
    session = Session(text("address", address), text("name", name), timeout_s, key, lease)
    try:
        session.ask("subscribe", subscription)
        return Arm(session)
    except BaseException:
        session.close()
        raise
