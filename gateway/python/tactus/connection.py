"""A connection to a server: requests on their way, and what has come back."""

import collections
import contextlib
import threading
import time
import warnings
from typing import Any, Callable, TypeVar

from . import tactus_pb2 as pb
from .arguments import Path, whole
from .clock import Clock
from .errors import Error, Lost, Refused
from .link import Link
from .messages import Event, Feedback, RobotDescription, event_of, feedback_of, robot_of
from .protocol import LATEST_NS, Outcome

T = TypeVar("T")

_PING_S = 0.1  # between two measurements of the clock, which also renew the lease
_MOST_CALLS = 16384  # that a server may leave unanswered
_REPORTED = {"point", "velocity", "chunk", "begin", "parameters"}
_REPORTED |= {"cancel", "override", "pause", "resume", "stop", "rearm", "tare"}


class Call:
    """A request on its way: its Answer, and its latest Report if it is of a kind that has one."""

    def __init__(self, kind: str):
        self.kind = kind
        self.answer: pb.Answer | None = None
        self.report: pb.Report | None = None
        self.page: pb.ParameterPage | None = None
        self.feedback: collections.deque[Feedback] = collections.deque(maxlen=1024)

    @property
    def final(self) -> bool:
        """Nothing more is to come."""
        if self.answer is None:
            return False
        if self.answer.status or self.kind not in _REPORTED:
            return True
        return self.report is not None and Outcome(self.report.outcome).final

    def refusal(self) -> Refused | None:
        """What the server has refused it with."""
        said: pb.Answer | pb.Report
        if self.answer is not None and self.answer.status:
            said = self.answer
        elif self.report is not None and self.report.outcome == pb.Report.REFUSED:
            said = self.report
        else:
            return None
        finding = said.finding if said.HasField("finding") else None
        return Refused(said.text or f"the server refused {self.kind}", said.status, finding)

    def judge(self) -> None:
        """Raises what the server has refused it with."""
        if refusal := self.refusal():
            raise refusal


class Session:
    """One connection: numbers, answers, states, and the thread that reads them and keeps the lease alive."""

    robot: RobotDescription

    def __init__(self, address: str, name: str, timeout_s: float, key: Path | None, lease: pb.Lease):
        self.address = address
        self.timeout_s = timeout_s
        self.clock = Clock()
        self.leased = False
        self.upload = threading.Lock()  # one trajectory at a time is under way to the server
        self.uploader: threading.Thread | None = None
        self.news = threading.Condition()  # guards all below
        self.state: pb.State | None = None
        self.events: collections.deque[Event] = collections.deque(maxlen=1024)
        self.credit = 0
        self.epoch = 0
        self.stops = 0  # the latest stop, cancel, pause or lower override that the server has told of
        self.sequence = 0  # of the latest reference of a stream
        self.starved = 0
        self.broken: Lost | None = None
        self._lease = lease
        self._welcome: pb.Welcome | None = None
        self._reported_ns = 0  # the latest report, by the server's clock
        self._calls: dict[int, Call] = {}
        self._number = 0
        self._sending = threading.Lock()
        self._heard = time.monotonic()
        self._link = Link(address, timeout_s, key)
        self._thread = threading.Thread(target=self._run, name="tactus", daemon=True)
        try:
            self._thread.start()
            self._greet(name)
        except BaseException:
            self.close()
            raise

    def _greet(self, name: str) -> None:
        client = name.encode()[:31].decode(errors="ignore")
        hello = self.send("hello", pb.Hello(version=pb.VERSION_PRESENT, client=client))
        self.wait(lambda: bool(self._welcome or hello.refusal()), "welcome")
        hello.judge()
        welcome = self._welcome
        assert welcome
        if welcome.version != pb.VERSION_PRESENT:
            raise Lost(
                f"{self.address}: the server speaks version {welcome.version} of the protocol, this library"
                f" version {pb.VERSION_PRESENT}; install the same release of both"
            )
        self.robot = robot_of(welcome)

    def send(self, kind: str, request: Any) -> Call:
        """Sends a request and returns its call, which is answered later."""
        with self._sending:
            return self._send(kind, request)

    def _send(self, kind: str, request: Any) -> Call:
        call = Call(kind)
        with self.news:
            if self.broken:
                raise self.broken
            self._number += 1
            number = self._number
            self._calls[number] = call
            if len(self._calls) > _MOST_CALLS:
                self._fail(f"the server has left {_MOST_CALLS} requests unanswered")
        message = pb.ToServer(number=number, client_ns=time.monotonic_ns())
        getattr(message, kind).CopyFrom(request)
        if kind == "begin" and request.wrap:
            message.requires.append(pb.FEATURE_WRAP)
        try:
            self._link.send(message)
        except Lost as error:
            if threading.current_thread() is self._thread:
                return call  # it reads next what the server has said last
            with self.news:
                self.news.wait_for(lambda: self.broken, _PING_S)
                raise self._fail(error)
        except ValueError:
            with self.news:
                del self._calls[number]
            raise
        return call

    def ask(self, kind: str, request: Any, *, lasts: bool = False) -> Call:
        """Sends a request and returns its call once it is answered and in force; raises Refused if it was not taken.

        lasts -- only the answer comes within `timeout_s`: the server takes its time for what it reports
        """
        call = self.send(kind, request)
        if lasts:
            self.wait(lambda: call.answer, f"answer to {kind}")
            self.wait_long(lambda: call.final, f"report on {kind}", None)
        else:
            self.wait(lambda: call.final, f"answer to {kind}")
        call.judge()
        return call

    def wait(self, predicate: Callable[[], T | None], what: str) -> T:
        """Returns what the predicate does, once it is true; a server that lets `timeout_s` pass before has failed."""
        try:
            return self.wait_long(predicate, what, self.timeout_s)
        except TimeoutError as error:
            with self.news:
                raise self._fail(error) from None

    def wait_long(self, predicate: Callable[[], T | None], what: str, timeout_s: float | None) -> T:
        """Returns what the predicate does, once it is true; without end if `timeout_s` is None."""
        with self.news:
            if not self.news.wait_for(lambda: predicate() or self.broken, timeout_s):
                raise TimeoutError(f"no {what} within {timeout_s} s")
            if value := predicate():
                return value
            assert self.broken
            raise self.broken

    def own(self) -> int:
        """Takes or renews the lease, and returns the present epoch."""
        answer = self.ask("lease", self._lease).answer
        assert answer
        self.leased = True
        return answer.epoch

    def release(self) -> None:
        """Gives the lease back, if this client has it."""
        if self.leased:
            self.ask("lease", pb.Lease(wish=pb.Lease.RELEASE))
            self.leased = False

    def cancel(self) -> None:
        """Cancels what runs, if anything does and the server is still there."""
        with contextlib.suppress(Error):
            self.ask("cancel", pb.Cancel())

    def server_stamp(self, name: str, local_ns: int) -> int:
        """Returns a stamp of the caller by the clock of the server."""
        return self.clock.to_server(whole(name, local_ns, -LATEST_NS, LATEST_NS))

    def present_state(self) -> pb.State | None:
        """The latest State, None if a report is newer."""
        return self.state if self.state is not None and self.state.server_ns >= self._reported_ns else None

    def close(self) -> None:
        with self.news:
            self._fail("the connection is closed")
        self._link.close()
        if self._thread.is_alive() and threading.current_thread() is not self._thread:
            self._thread.join(self.timeout_s)

    def _fail(self, why: object) -> Lost:
        """Ends the connection for all who wait, if it has not ended before; returns the error that did."""
        self.broken = self.broken or Lost(f"{self.address}: {why}")
        self.news.notify_all()
        return self.broken

    def _run(self) -> None:
        ping = time.monotonic()
        try:
            while not self.broken:
                if time.monotonic() >= ping and self._welcome:
                    ping = time.monotonic() + _PING_S
                    self._ping()
                for message in self._link.receive(ping - time.monotonic() if self._welcome else _PING_S):
                    self._heard = time.monotonic()
                    with self.news:
                        self._take(message)
                        self.news.notify_all()
                if self._welcome and time.monotonic() - self._heard > self.timeout_s:
                    raise Lost(f"the server has been silent for {self.timeout_s} s")
        except Exception as error:  # of whatever kind: those who wait must know
            with self.news:
                self._fail(error)
        finally:
            self._link.close()

    def _ping(self) -> None:
        """Sends a Ping, or nothing if another message is being sent, which renews the lease as well. Never blocks."""
        if self._link.can_send() and self._sending.acquire(blocking=False):
            try:
                self._send("ping", pb.Ping())
            finally:
                self._sending.release()

    def _take(self, message: pb.ToClient) -> None:
        kind = message.WhichOneof("message")
        if kind == "welcome":
            if self._welcome:
                raise Lost("the server has welcomed this client twice")
            self._welcome = message.welcome
            self._calls.pop(message.welcome.number, None)
            self._count(message.welcome)
        elif kind == "answer":
            self._take_answer(message.answer)
        elif kind == "report":
            self._take_report(message.report)
        elif kind == "state":
            self.state = message.state
            self._count(message.state)
        elif kind == "feedback":
            if call := self._calls.get(message.feedback.number):
                call.feedback.append(feedback_of(message.feedback))
        elif kind == "event":
            self.events.append(event_of(message.event, self.clock))
        elif kind == "parameter_page":
            if call := self._calls.get(message.parameter_page.number):
                call.page = message.parameter_page
        elif kind == "credit":
            self.credit += message.credit.waypoints

    def _count(self, told: pb.Welcome | pb.Answer | pb.State) -> None:
        self.epoch = max(self.epoch, told.epoch)
        self.stops = max(self.stops, told.stops)

    def _take_answer(self, answer: pb.Answer) -> None:
        if answer.number == 0:
            raise Lost(f"the server ends the connection: {answer.text}")
        call = self._calls.get(answer.number)
        if call is None or call.answer is not None:
            why = "twice" if answer.number <= self._number else "that was never sent"
            raise Lost(f"the server has answered request {answer.number} {why}; it does not keep to the protocol")
        call.answer = answer
        self._count(answer)
        if answer.received_ns:
            stamps = (answer.client_ns, answer.received_ns, answer.server_ns)
            if any(abs(stamp) > LATEST_NS for stamp in stamps):
                raise Lost(f"the server has answered with the stamps {stamps}, which are those of no clock")
            self.clock.add(*stamps, time.monotonic_ns())
        if call.kind == "begin":
            self.credit = 0  # Credits of an older trajectory end here
        if call.final:
            del self._calls[answer.number]

    def _take_report(self, report: pb.Report) -> None:
        if report.outcome not in pb.Report.Outcome.values():
            raise Lost(
                f"the server has reported the outcome {report.outcome} of request {report.number}, which this library"
                " does not know; install the same release of both"
            )
        call = self._calls.get(report.number)
        if call is None and report.outcome == pb.Report.STARVED:
            self.starved += 1  # a chunk or a velocity that was in force, and that no other has followed
            return
        if call is None:
            raise Lost(f"the server has reported on request {report.number}, which has ended or was never sent")
        call.report = report
        if report.status == pb.CODE_PAUSED:
            warnings.warn("a pause holds the arm: the trajectory waits for resume()", stacklevel=2)
        elif call.kind == "begin" and report.status == pb.CODE_OK and report.text:
            warnings.warn(report.text, stacklevel=2)
        self._reported_ns = report.server_ns
        if call.final:
            del self._calls[report.number]
