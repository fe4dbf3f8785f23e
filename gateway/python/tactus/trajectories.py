"""Trajectories on their way to the server, and how they end."""

import contextlib
import threading
from typing import Iterator

from . import tactus_pb2 as pb
from .arguments import number
from .connection import Session
from .errors import Aborted, Error, Lost, Refused
from .messages import Feedback, Result, result_of
from .protocol import LONGEST_MESSAGE, LONGEST_WAIT_S, Array, Outcome


class Motion:
    """A trajectory that the server has accepted (`Arm.start`). Iterate over it for feedback, or `wait` for its end.

    Ctrl-C in either cancels it, on its path, and raises KeyboardInterrupt.
    """

    def __init__(self, session: Session, begin: pb.Begin, times: Array, numbers: Array):
        self._session = session
        self._times, self._numbers = times, numbers
        self._sent = 0
        self._thread = threading.Thread(target=self._feed, name="tactus waypoints", daemon=True)
        with self._on_interrupt():
            with session.upload:
                session.uploader = self._thread
                self._call = session.send("begin", begin)
            session.wait(lambda: self._call.answer, "answer to begin")
            self._call.judge()
            self._thread.start()
            self._await_verdict()
        self._call.judge()

    @property
    def result(self) -> Result | None:
        """How it has ended; None while it runs."""
        told = self._call.report
        return result_of(told) if told is not None and Outcome(told.outcome).final else None

    def wait(self, timeout_s: float | None = None) -> Result:
        """Waits for the end, and returns the Result if it succeeded, was preempted or canceled.

        Raises Aborted if the robot gave it up, Refused if a later waypoint was not accepted, Lost if the connection
        ends; TimeoutError after `timeout_s`, 0 to 86 400, if given: the trajectory goes on.
        """
        if timeout_s is not None:
            timeout_s = number("timeout_s", timeout_s, 0, LONGEST_WAIT_S)
        with self._on_interrupt():
            result = self._session.wait_long(lambda: self.result, "end of the trajectory", timeout_s)
        self._call.judge()
        if result.outcome == Outcome.ABORTED:
            raise Aborted(result)
        return result

    def __iter__(self) -> Iterator[Feedback]:
        """Yields Feedback until the trajectory has ended; then raises what `wait` would raise."""
        while True:
            with self._on_interrupt():
                self._session.wait_long(lambda: self._call.feedback or self.result, "Feedback", None)
            if not self._call.feedback:
                self.wait()
                return
            yield self._call.feedback.popleft()

    def cancel(self) -> Result:
        """Ends it on its path and returns its Result, also if it has ended before. Raises what `wait` does."""
        if self.result is None:
            try:
                self._session.ask("cancel", pb.Cancel())
            except Refused:
                if self.result is None:
                    raise
        return self.wait()

    @contextlib.contextmanager
    def _on_interrupt(self) -> Iterator[None]:
        try:
            yield
        except KeyboardInterrupt:
            self._session.cancel()
            raise

    def _await_verdict(self) -> None:
        """Waits until the server has accepted it or not; as long as waypoints go out, it may take its time."""
        sent = -1
        while sent != self._sent:
            sent = self._sent
            with contextlib.suppress(TimeoutError):
                self._session.wait_long(lambda: self._call.report, "verdict", self._session.timeout_s)
                return
        raise Lost(f"{self._session.address}: no verdict on a trajectory within {self._session.timeout_s} s")

    def _feed(self) -> None:
        """Sends the waypoints as there is credit, until all are, a newer trajectory is begun, or this one ends."""
        session = self._session
        part = min(session.robot.longest_part, (LONGEST_MESSAGE - 64) // (8 * (self._numbers.shape[1] + 1)))
        with contextlib.suppress(Error):  # the call that waits for the motion raises it
            while True:
                done = self._sent == len(self._times)
                if not done:
                    session.wait_long(lambda: session.credit > 0 or self._call.final, "Credit", None)
                with session.upload:
                    if session.uploader is not self._thread or self._call.final:
                        return
                    if done:
                        session.send("end", pb.End())
                        return
                    with session.news:
                        count = min(part, session.credit, len(self._times) - self._sent)
                        session.credit -= count
                    rows = slice(self._sent, self._sent + count)
                    numbers = self._numbers[rows].ravel().tolist()
                    session.send("part", pb.Part(time_s=self._times[rows].tolist(), numbers=numbers))
                    self._sent += count
