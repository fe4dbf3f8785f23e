"""tactus: moves a robot arm through the gateway of a Tactus server.

    import numpy as np
    import tactus

    with tactus.connect("unix:/run/tactus/socket") as arm:
        here = arm.state().q
        t = np.linspace(0.5, 3.0, 6)
        path = here + np.outer(1 - np.cos(np.linspace(0, np.pi, 6)), 0.1 * np.ones(arm.robot.dof))
        for feedback in arm.start(q=path, t=t):
            print(feedback.time_s, feedback.desired.q - feedback.actual.q)

Units are SI: rad, m, s, N, N m. Joints come in the order of `arm.robot.joints`. A pose is seven numbers
(x, y, z, qw, qx, qy, qz), a twist six (vx, vy, vz, wx, wy, wz), a wrench six (fx, fy, fz, mx, my, mz), all of the tool
tip in the axes of the base; a wrench is what the environment exerts on the tool. n of them are n rows.
Times named *_ns are nanoseconds of this process's `time.monotonic_ns()`; the library converts them to the clock of the
server and follows its drift.

Errors are subclasses of `tactus.Error`. A mistake of the caller that can be seen without the server (the shape of an
array, two kinds of target at once, a number out of its range) is a ValueError; nothing was sent. No call waits without
end: a server that is silent for `timeout_s` has failed (Lost). The arm never depends on this process: if it dies, the
server brings the arm to rest.

All methods may be called from any thread. The library needs numpy and protobuf; `make python` writes it with the module
tactus_pb2 into build/python.
"""

from __future__ import annotations

import collections
import contextlib
import ctypes
import ctypes.util
import dataclasses
import enum
import hashlib
import os
import pathlib
import re
import reprlib
import secrets
import select
import socket
import stat
import subprocess
import sys
import tempfile
import threading
import time
import warnings
from typing import Any, Callable, Iterator, Mapping, Optional, Sequence, TypeVar, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

try:
    import google.protobuf.message
    import tactus_pb2 as pb
except ImportError as error:
    raise ImportError(f"{error}; run `make python` and add build/python to PYTHONPATH") from error

__all__ = [
    "Aborted",
    "Arm",
    "Chunks",
    "Code",
    "Error",
    "Event",
    "Feedback",
    "Joint",
    "Lost",
    "Motion",
    "Outcome",
    "Parameter",
    "Phase",
    "Refused",
    "Result",
    "Robot",
    "Rung",
    "Sample",
    "State",
    "Stopped",
    "Stream",
    "connect",
    "serve",
    "sim",
]

Array = NDArray[np.float64]
T = TypeVar("T")
Self = TypeVar("Self", bound="_References")

_TASK_WIDTHS = {"pose": 7, "twist": 6, "acceleration": 6, "wrench": 6}
_LONGEST_MESSAGE = 16 * 1024  # bytes; tactus.proto
_BYTES = {"frame": 63, "section": 31, "key": 31, "value": 191}  # of texts; docs/gateway.md, gateway/tactus.options
_MOST_PARAMETERS, _MOST_CHANNELS = 32, 8  # of a message; who sends more is cut
_LATEST_NS = 2**61  # of a clock, 73 years: the sum of two fits in 64 bits
_LONGEST_WAIT_S = 86400.0
_PING_S = 0.1  # between two measurements of the clock, which also renew the lease
_UNREPORTED = 12  # references of a stream that wait for their reports; the server has space for 16 requests
_REPORTED = {"point", "velocity", "chunk", "begin", "parameters"}
_REPORTED |= {"cancel", "override", "pause", "resume", "stop", "rearm", "tare"}


# --- errors ---


class Error(Exception):
    """Every error of this library that is not a mistake of the caller."""


class Lost(Error):
    """There is no connection, it has ended, or the server does not keep to the protocol. The text says which."""


class Refused(Error):
    """The server refused a request; nothing has changed. The text names place, value, limit and remedy.

    status       -- the Code of the reason, also a number: docs/reference-generators.md
    place        -- "waypoint 13, joint 3 (elbow_joint)", or ""
    waypoint     -- of it, or target, from 0; None: none in particular
    axis         -- of it: joint, or axis of the tip, from 0; None: none in particular
    value, limit -- in the unit that the text names, or None
    remedy       -- what to do, or ""
    """

    def __init__(self, text: str, status: int, finding: Optional["pb.Finding"] = None):
        super().__init__(f"{text} ({int(status)})" if f"({int(status)})" not in text else text)
        self.status = _named(Code, status)
        reason, _, self.remedy = text.partition("; ")
        self.place = reason.partition(": ")[0] if ": " in reason else ""
        given = finding is not None
        self.waypoint = finding.waypoint if given and finding.waypoint >= 0 else None
        self.axis = finding.axis if given and finding.axis >= 0 else None
        self.value = finding.value if given else None
        self.limit = finding.limit if given else None


class Aborted(Error):
    """A trajectory was given up by the robot: a tolerance was violated, or a fault brakes the arm. `result` has it."""

    def __init__(self, result: Result):
        super().__init__(result.text or f"aborted ({int(result.status)})")
        self.result = result


class Stopped(Error):
    """A stop has made the stream void that this reference belongs to; open a new stream to go on."""


# --- arguments ---


def _real(name: str, values: Any, expected: str = "real numbers") -> NDArray[Any]:
    """Returns them as an array; ValueError if they are anything else, texts or complex numbers for example."""
    cause: Optional[Exception] = None
    try:
        array = np.asarray(values)
        if array.dtype.kind in "biuf":
            return array
    except Exception as error:  # of whatever kind: values of other libraries convert themselves
        cause = error
    raise ValueError(f"{name} is {reprlib.repr(values)}; expected {expected}") from cause


def _number(name: str, value: Any, low: float, high: float, whole: bool = False) -> Any:
    """Returns it as a number of Python; ValueError if it is not one from `low` to `high`."""
    expected = f"a {'whole ' * whole}number from {low:.10g} to {high:.10g}"
    number = _real(name, value, expected)
    if number.ndim or not low <= number.item() <= high or (whole and number % 1):
        raise ValueError(f"{name} is {reprlib.repr(value)}; expected {expected}")
    return number.item()


def _whole(name: str, value: Any, low: int, high: int) -> int:
    return int(_number(name, value, low, high, whole=True))


def _flag(name: str, value: Any) -> bool:
    return bool(_whole(name, value, 0, 1))


def _milliseconds(name: str, value_s: Any, low_s: float, high_s: float) -> int:
    return round(_number(name, value_s, low_s, high_s) * 1000)


def _text(name: str, value: Any, most: int = _LONGEST_MESSAGE) -> str:
    """Returns it; ValueError if it is no text, or longer than `most` bytes."""
    try:
        size = len(value.encode())
    except (AttributeError, UnicodeError) as error:
        raise ValueError(f"{name} is {reprlib.repr(value)}; expected a text") from error
    if size > most:
        raise ValueError(f"{name} has {size} bytes; at most {most} are taken")
    return str(value)


# --- what the server says ---


class Outcome(enum.IntEnum):
    """How a reference is doing (up to STARVED) or has ended."""

    UNKNOWN = 0
    SCHEDULED = 1
    STARTED = 2
    STARVED = 3
    SUCCEEDED = 10
    PREEMPTED = 11
    ABORTED = 12
    CANCELED = 13
    EXECUTED = 14
    SUPERSEDED = 15
    REFUSED = 16

    @property
    def final(self) -> bool:
        return self >= Outcome.SUCCEEDED


def _names(name: str, prefix: str, numbers: Mapping[str, int]) -> Any:
    return enum.IntEnum(name, {key.removeprefix(prefix): number for key, number in numbers.items()}, module=__name__)


Rung = _names("Rung", "RUNG_", dict(pb.Rung.items()))
Rung.__doc__ = "The ladder by which the arm stops in stages: NOMINAL, ... as in tactus.proto."
Phase = _names("Phase", "PHASE_", dict(pb.Phase.items()))
Phase.__doc__ = "The phase of the motion: HOLDING, FOLLOWING, PAUSED, ... as in tactus.proto."
Code = _names("Code", "CODE_", dict(pb.Code.items()))
Code.__doc__ = "Why something was refused, ended or stopped: OK, VELOCITY_LIMIT, ... as in tactus.proto."


def _named(kind: Any, number: int) -> int:
    """Returns the member with this number; the number itself if a newer server has sent one without a name."""
    return kind(number) if number in kind.__members__.values() else number


@dataclasses.dataclass(frozen=True)
class Joint:
    """A joint and its limits: rad, rad/s, rad/s^2, rad/s^3, N m."""

    name: str
    min_rad: float
    max_rad: float
    velocity: float
    acceleration: float
    jerk: float
    effort: float
    continuous: bool = False  # it has no end: angles that differ by whole turns are the same place


@dataclasses.dataclass(frozen=True)
class Robot:
    """What the server said when the connection was made."""

    board: str
    name: str
    pipeline: str
    configuration: int  # hash of the pipeline file
    period_s: float
    joints: tuple[Joint, ...]
    takes_joints: bool
    takes_poses: bool
    longest_chunk: int  # targets
    window: int  # waypoints that the server holds at once
    longest_part: int  # waypoints of a message
    outputs: Mapping[int, str]  # digital outputs that can be set, with the robot's names for them, or ""

    @property
    def dof(self) -> int:
        """The number of joints."""
        return len(self.joints)


@dataclasses.dataclass(frozen=True)
class Sample:
    """A reference or a measurement; a field that was not given is None."""

    q: Optional[Array] = None
    dq: Optional[Array] = None
    ddq: Optional[Array] = None
    tau: Optional[Array] = None
    pose: Optional[Array] = None
    twist: Optional[Array] = None
    acceleration: Optional[Array] = None
    wrench: Optional[Array] = None


@dataclasses.dataclass(frozen=True)
class Feedback:
    """Reference and measurement of one cycle while a trajectory is executed. `lost` messages before it were dropped.

    path_s of path_end_s of the trajectory's own time have passed; they wait in a pause and slow down with an override.
    """

    time_s: float
    desired: Sample
    actual: Sample
    lost: int
    path_s: float
    path_end_s: float  # time of the last waypoint that the server has


@dataclasses.dataclass(frozen=True)
class Result:
    """How a trajectory has ended. `stretch` is the fraction by which it was slowed down to keep the limits."""

    outcome: Outcome
    status: int  # a Code
    text: str
    time_s: float
    stretch: float

    @property
    def succeeded(self) -> bool:
        return self.outcome == Outcome.SUCCEEDED


@dataclasses.dataclass(frozen=True)
class Event:
    """An entry of the server's event log."""

    stamp_ns: int
    name: str
    status: int  # a Code
    text: str


@dataclasses.dataclass(frozen=True)
class Parameter:
    """A parameter of the pipeline that runs; values are words as in its file."""

    section: str
    key: str
    value: str
    unit: str
    range: str
    file_value: str  # that of the file
    tunable: bool  # it may change while the pipeline runs

    @property
    def numbers(self) -> Array:
        """The value as numbers; one if it is the same for all joints. Raises ValueError if it is a word."""
        return np.array(self.value.split(), dtype=float)


@dataclasses.dataclass(frozen=True)
class State:
    """The arm in one cycle. `stamp_ns` is the begin of the cycle by this process's time.monotonic_ns()."""

    stamp_ns: int
    server_ns: int  # the same by the server's clock
    cycle: int
    rung: int  # a Rung; from HOLD on no references are taken
    status: int  # a Code: why it is not nominal
    phase: int  # a Phase of the motion
    epoch: int
    owner: str  # the client that holds the lease; "" if nobody does
    override: float
    speed_scaling: float
    q: Array
    dq: Array
    tau: Array
    q_d: Optional[Array]
    dq_d: Optional[Array]
    pose: Optional[Array]
    pose_d: Optional[Array]
    wrench: Optional[Array]
    margin_s: float  # until a stream starves
    slips: int
    overruns: int
    lost: int  # States that were not sent since the connection was made
    chunks_taken: int
    chunks_late: int
    chunks_dropped: int
    targets_trimmed: int
    seam: float  # largest difference at the latest seam, rad, or m and rad
    outputs: Mapping[int, bool]  # digital outputs as commanded; those that were left alone are not in it


def _array(numbers: Sequence[float]) -> Optional[Array]:
    return np.array(numbers, dtype=float) if len(numbers) else None


def _sample(joint: pb.JointPoint, task: pb.TaskPoint) -> Sample:
    return Sample(
        *map(_array, (joint.q, joint.dq, joint.ddq, joint.tau, task.pose, task.twist, task.acceleration, task.wrench))
    )


# --- the clock of the server ---


class _Clock:
    """Estimates the server's clock from request and answer: the offset by the shortest round trips, and its drift.

    A round trip that took `trip` ns bounds the offset to half of it. Of each tenth of a second the shortest is kept; a
    line is fitted to the offsets of the last 13 s, in which a trip counts the less the longer it took.
    """

    KEPT = 128
    BETWEEN_NS = 100_000_000
    FLOOR_NS = 20_000.0  # by which round trips vary on an idle machine

    def __init__(self) -> None:
        self._kept: collections.deque[tuple[int, int, int]] = collections.deque(maxlen=self.KEPT)  # local, offset, trip
        self._line = (0, 0.0, 0.0)  # at a local time: offset, drift
        self.uncertainty_ns = float("inf")

    def add(self, sent: int, came: int, left: int, received: int) -> None:
        """Takes one exchange: sent and received by the local clock, came and left by the server's. [ns]"""
        trip = max(0, (received - sent) - (left - came))
        if self._kept and received - self._kept[-1][0] < self.BETWEEN_NS:
            if trip >= self._kept[-1][2]:
                return
            self._kept.pop()
        self._kept.append((received, (came + left - sent - received) // 2, trip))
        self._fit()

    def _fit(self) -> None:
        last, first_offset, _ = self._kept[-1][0], *self._kept[0][1:]
        at, offsets, trips = np.array([(t - last, o - first_offset, trip) for t, o, trip in self._kept], dtype=float).T
        weights = (trips - trips.min() + self.FLOOR_NS) ** -2
        weights /= weights.sum()
        at_mean, mean = weights @ at, weights @ offsets
        drift = 0.0
        if -at[0] > 5 * self.BETWEEN_NS:
            drift = weights @ ((at - at_mean) * (offsets - mean)) / (weights @ (at - at_mean) ** 2)
        self._line = (last, first_offset + mean - drift * at_mean, float(drift))
        self.uncertainty_ns = trips.min() / 2

    def to_server(self, local_ns: int) -> int:
        at, offset, drift = self._line
        return int(local_ns + offset + drift * (local_ns - at))

    def to_local(self, server_ns: int) -> int:
        at, offset, drift = self._line
        return int(at + (server_ns - offset - at) / (1.0 + drift))


# --- bytes ---


class _Tunnel:
    """The client's end of an encrypted connection; gateway/sockets/tunnel.hpp describes the bytes. Needs libsodium."""

    PROTOCOL = b"tactus-1"
    ANSWER_BYTES = 32 + 24  # X25519 key of the server, header of its stream
    RECORD_BYTES = 4096  # of plain bytes, at most
    TAG_BYTES = 17  # by which a record is longer

    def __init__(self, key_file: Union[str, os.PathLike[str]]):
        self._key = self._read(pathlib.Path(key_file))
        try:
            self._sodium = ctypes.CDLL(ctypes.util.find_library("sodium") or "libsodium.so.23")
        except OSError as error:
            raise Error(f"{error}; a connection with a key needs the package libsodium23") from error
        if self._sodium.sodium_init() < 0:
            raise Error("libsodium cannot be used on this machine")
        self._stream = "crypto_secretstream_xchacha20poly1305_"
        self._own, self._public = secrets.token_bytes(32), ctypes.create_string_buffer(32)
        self._sodium.crypto_scalarmult_base(self._public, self._own)
        size = self._sodium[self._stream + "statebytes"]()
        self._out, self._in = (ctypes.create_string_buffer(size) for _ in range(2))
        self._sealed = bytearray()

    @staticmethod
    def _read(file: pathlib.Path) -> bytes:
        try:
            found = file.stat()
            if not stat.S_ISREG(found.st_mode) or found.st_uid != os.geteuid() or found.st_mode & 0o077:
                raise ValueError(f"key {file}: others may read it, or it is no file: make it yours, then chmod 600")
            digits = file.read_text(encoding="ascii", errors="replace").rstrip("\r\n")
        except OSError as error:
            raise ValueError(f"key {file}: {error.strerror}; openssl rand -hex 32 makes its content") from error
        if not re.fullmatch("[0-9a-fA-F]{64}", digits):
            raise ValueError(f"key {file}: it does not hold 64 hexadecimal digits; openssl rand -hex 32 makes them")
        return bytes.fromhex(digits)

    def hello(self) -> bytes:
        return self.PROTOCOL + self._public.raw

    def answer(self, reply: bytes) -> bytes:
        """Takes the server's key and header; returns the header of the client's stream."""
        server, header, secret = reply[:32], reply[32:], ctypes.create_string_buffer(32)
        if self._sodium.crypto_scalarmult(secret, self._own, server):
            raise Lost("the server has sent a key that is none")
        shared = self.PROTOCOL + secret.raw + self._public.raw + server
        keys = hashlib.blake2b(shared, key=self._key, digest_size=64).digest()
        own_header = ctypes.create_string_buffer(24)
        self._sodium[self._stream + "init_push"](self._out, own_header, keys[:32])
        self._sodium[self._stream + "init_pull"](self._in, header, keys[32:])
        return own_header.raw

    def seal(self, plain: bytes) -> bytes:
        records = bytearray()
        for begin in range(0, len(plain), self.RECORD_BYTES):
            piece = plain[begin : begin + self.RECORD_BYTES]
            sealed = ctypes.create_string_buffer(len(piece) + self.TAG_BYTES)
            self._sodium[self._stream + "push"](
                self._out, sealed, None, piece, ctypes.c_ulonglong(len(piece)), None, ctypes.c_ulonglong(0), 0
            )
            records += len(sealed).to_bytes(2, "little") + sealed.raw
        return bytes(records)

    def open(self, sealed: bytes) -> bytes:
        """Returns the plain bytes of the records that are complete; keeps the rest."""
        self._sealed += sealed
        plain = bytearray()
        while len(self._sealed) >= 2:
            size = int.from_bytes(self._sealed[:2], "little")
            if len(self._sealed) < 2 + size:
                break
            record, piece = bytes(self._sealed[2 : 2 + size]), ctypes.create_string_buffer(max(1, size))
            del self._sealed[: 2 + size]
            bad = size < self.TAG_BYTES or self._sodium[self._stream + "pull"](
                self._in, piece, None, None, record, ctypes.c_ulonglong(size), None, ctypes.c_ulonglong(0)
            )
            if bad:
                raise Lost("a record does not open: the server has another key, or somebody has changed it")
            plain += piece.raw[: size - self.TAG_BYTES]
        return bytes(plain)


class _Link:
    """Messages over a stream socket: a length of four bytes, least significant first, and the message."""

    def __init__(self, address: str, timeout_s: float, key: Union[str, os.PathLike[str], None]):
        self.address = address
        self._bytes = bytearray()
        self._heard = False
        self._tunnel = None if key is None else _Tunnel(key)
        kind, _, place = address.partition(":")
        host, _, port = place.rpartition(":")
        target: Union[str, tuple[str, int]]
        if kind == "unix" and place:
            self._socket, target = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM), place
        elif kind == "tcp" and host and re.fullmatch("[0-9]{1,5}", port) and int(port) < 65536:
            family = socket.AF_INET6 if ":" in host else socket.AF_INET
            self._socket, target = socket.socket(family, socket.SOCK_STREAM), (host.strip("[]"), int(port))
            self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        else:
            raise ValueError(f"address {address!r}: write unix:/path/of/the/socket or tcp:HOST:PORT; PORT to 65535")
        try:
            self._socket.settimeout(timeout_s)
            self._socket.connect(target)
            if self._tunnel:
                self._shake_hands(self._tunnel)
        except BaseException as error:
            self._socket.close()
            if isinstance(error, OSError):
                why = f"{error.strerror or error}; is a tactus server running there?"
                raise Lost(f"{address}: {why}") from error
            if isinstance(error, (TypeError, ValueError)):  # of Python: no name of a host
                raise ValueError(f"address {address!r}: {error}") from error
            raise

    def _shake_hands(self, tunnel: _Tunnel) -> None:
        try:
            self._socket.sendall(tunnel.hello())
            reply = b""
            while len(reply) < tunnel.ANSWER_BYTES:
                piece = self._socket.recv(tunnel.ANSWER_BYTES - len(reply))
                if not piece:
                    raise ConnectionError("the server has ended the connection")
                reply += piece
            self._socket.sendall(tunnel.answer(reply))
        except (OSError, Lost) as error:
            raise Lost(f"{self.address}: {error}; does the server have a key?") from error

    def send(self, message: pb.ToServer) -> None:
        body = message.SerializeToString()
        if len(body) > _LONGEST_MESSAGE:
            raise ValueError(f"a message of {len(body)} bytes; at most {_LONGEST_MESSAGE} are taken")
        data = len(body).to_bytes(4, "little") + body
        try:
            self._socket.sendall(self._tunnel.seal(data) if self._tunnel else data)
        except OSError as error:
            if isinstance(error, TimeoutError):
                raise Lost(f"{self.address}: the server takes no more: {error}") from error
            raise self._ended(f": {error.strerror}") from error
        except BaseException:  # Ctrl-C, perhaps within the message: nothing can follow it
            self._socket.shutdown(socket.SHUT_RDWR)
            raise

    def _ended(self, how: str) -> Lost:
        hint = "" if self._heard else "; do both ends have the same key, or none?"
        return Lost(f"{self.address}: the server has ended the connection{how}{hint}")

    def can_send(self) -> bool:
        return bool(select.select([], [self._socket], [], 0)[1])

    def receive(self, wait_s: float) -> Iterator[pb.ToClient]:
        """Yields the messages that are complete after at most `wait_s`."""
        if not select.select([self._socket], [], [], max(0.0, wait_s))[0]:
            return
        try:
            piece = self._socket.recv(1 << 16)
        except OSError as error:
            raise self._ended(f": {error.strerror}") from error
        if not piece:
            raise self._ended(" within a message" if self._bytes else "")
        self._bytes += self._tunnel.open(piece) if self._tunnel else piece
        while len(self._bytes) >= 4:
            length = int.from_bytes(self._bytes[:4], "little")
            if length > _LONGEST_MESSAGE:
                raise Lost(f"{self.address}: a message of {length} bytes; this is no tactus server")
            if len(self._bytes) < 4 + length:
                return
            body = bytes(self._bytes[4 : 4 + length])
            del self._bytes[: 4 + length]
            self._heard = True
            message = pb.ToClient()
            try:
                read = message.ParseFromString(body)
            except google.protobuf.message.DecodeError:
                read = -1
            if read != length:
                raise Lost(f"{self.address}: a message of {length} bytes cannot be read; this is no tactus server")
            yield message

    def close(self) -> None:
        with contextlib.suppress(OSError):
            self._socket.shutdown(socket.SHUT_RDWR)
        self._socket.close()


class _Call:
    """A request on its way: its Answer, and its latest Report if it is of a kind that has one."""

    def __init__(self, kind: str):
        self.kind = kind
        self.answer: Optional[pb.Answer] = None
        self.report: Optional[pb.Report] = None
        self.page: Optional[pb.ParameterPage] = None
        self.feedback: collections.deque[Feedback] = collections.deque(maxlen=1024)

    @property
    def final(self) -> bool:
        """Nothing more is to come."""
        if self.answer is None:
            return False
        if self.answer.status or self.kind not in _REPORTED:
            return True
        return self.report is not None and Outcome(self.report.outcome).final

    def refusal(self) -> Optional[Refused]:
        """What the server has refused it with."""
        said: Union[pb.Answer, pb.Report]
        if self.answer is not None and self.answer.status:
            said = self.answer
        elif self.report is not None and Outcome(self.report.outcome) == Outcome.REFUSED:
            said = self.report
        else:
            return None
        finding = said.finding if said.HasField("finding") else None
        return Refused(said.text or f"the server refused {self.kind}", said.status, finding)


class _Session:
    """One connection: numbers, answers, states, and the thread that reads them and keeps the lease alive."""

    def __init__(self, address: str, name: str, timeout_s: float, key: Union[str, os.PathLike[str], None]):
        self.address = address
        self.timeout_s = timeout_s
        self.clock = _Clock()
        self.news = threading.Condition()  # guards all below
        self.state: Optional[pb.State] = None
        self.welcome: Optional[pb.Welcome] = None
        self.events: collections.deque[Event] = collections.deque(maxlen=1024)
        self.credit = 0
        self.epoch = 0
        self.stops = 0  # the latest stop, cancel, pause or lower override that the server has told of
        self.reported_ns = 0  # the latest report, by the server's clock
        self.sequence = 0
        self.starved = 0
        self.broken: Optional[Error] = None
        self._calls: dict[int, _Call] = {}
        self._number = 0
        self._sending = threading.Lock()
        self._heard = time.monotonic()
        self._link = _Link(address, timeout_s, key)
        self._thread = threading.Thread(target=self._run, name="tactus", daemon=True)
        try:
            self._thread.start()
            self._greet(name)
        except BaseException:
            self.close()
            raise

    def _greet(self, name: str) -> None:
        hello = self.send(
            "hello", pb.Hello(version=pb.VERSION_PRESENT, client=name.encode()[:31].decode(errors="ignore"))
        )
        self.wait(lambda: self.welcome or hello.refusal(), "welcome")
        if refusal := hello.refusal():
            raise refusal
        assert self.welcome
        if self.welcome.version != pb.VERSION_PRESENT:
            raise Lost(
                f"{self.address}: the server speaks version {self.welcome.version} of the protocol, this library"
                f" version {pb.VERSION_PRESENT}; install the same release of both"
            )

    def send(self, kind: str, request: Any) -> _Call:
        """Sends a request and returns its call, which is answered later."""
        with self._sending:
            return self._send(kind, request)

    def _send(self, kind: str, request: Any) -> _Call:
        call = _Call(kind)
        with self.news:
            if self.broken:
                raise self.broken
            self._number += 1
            number = self._number
            self._calls[number] = call
            if len(self._calls) > 16384:
                self._fail(Lost(f"{self.address}: the server has left 16384 requests unanswered"))
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
                self._fail(error)
                raise self.broken or error
        except ValueError:
            with self.news:
                del self._calls[number]
            raise
        return call

    def ask(self, kind: str, request: Any) -> pb.Answer:
        """Sends a request and waits until it is answered and in force; raises Refused if it was not taken."""
        call = self.send(kind, request)
        self.wait(lambda: call.final, f"answer to {kind}")
        if refusal := call.refusal():
            raise refusal
        assert call.answer
        return call.answer

    def page(self, first: int) -> pb.ParameterPage:
        """Asks for the parameters from number `first` on; their page comes before the Answer."""
        call = self.send("list_parameters", pb.ListParameters(first=first))
        self.wait(lambda: call.final, "answer to list_parameters")
        if refusal := call.refusal():
            raise refusal
        if call.page is None:
            raise Lost(f"{self.address}: the server has answered without the page of parameters")
        return call.page

    def wait(self, predicate: Callable[[], Optional[T]], what: str) -> T:
        """Returns what the predicate does, once it is true; a server that lets `timeout_s` pass before has failed."""
        try:
            return self.wait_long(predicate, what, self.timeout_s)
        except TimeoutError as error:
            with self.news:
                self._fail(Lost(f"{self.address}: {error}"))
            raise self.broken or Lost() from None

    def wait_long(self, predicate: Callable[[], Optional[T]], what: str, timeout_s: Optional[float]) -> T:
        """Returns what the predicate does, once it is true; without end if `timeout_s` is None."""
        with self.news:
            if not self.news.wait_for(lambda: predicate() or self.broken, timeout_s):
                raise TimeoutError(f"no {what} within {timeout_s} s")
            if value := predicate():
                return value
            assert self.broken
            raise self.broken

    def present_state(self) -> Optional[pb.State]:
        """The latest State, None if a report is newer."""
        return self.state if self.state is not None and self.state.server_ns >= self.reported_ns else None

    def close(self) -> None:
        with self.news:
            self.broken = self.broken or Lost("the connection is closed")
            self.news.notify_all()
        self._link.close()
        if self._thread.is_alive() and threading.current_thread() is not self._thread:
            self._thread.join(self.timeout_s)

    def _fail(self, error: Error) -> None:
        self.broken = self.broken or error
        self.news.notify_all()

    def _run(self) -> None:
        ping = time.monotonic()
        try:
            while not self.broken:
                if time.monotonic() >= ping and self.welcome:
                    ping = time.monotonic() + _PING_S
                    self._ping()
                for message in self._link.receive(ping - time.monotonic() if self.welcome else _PING_S):
                    self._heard = time.monotonic()
                    with self.news:
                        self._take(message)
                        self.news.notify_all()
                if self.welcome and time.monotonic() - self._heard > self.timeout_s:
                    raise Lost(f"{self.address}: the server has been silent for {self.timeout_s} s")
        except Exception as error:  # of whatever kind: those who wait must know
            with self.news:
                self._fail(error if isinstance(error, Error) else Lost(f"{self.address}: {error}"))
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
            if self.welcome:
                raise Lost("the server has welcomed this client twice")
            self.welcome = message.welcome
            self.epoch = message.welcome.epoch
            self.stops = message.welcome.stops
            self._calls.pop(message.welcome.number, None)
        elif kind == "answer":
            self._take_answer(message.answer)
        elif kind == "report":
            self._take_report(message.report)
        elif kind == "state":
            self.state = message.state
            self.epoch = max(self.epoch, message.state.epoch)
            self.stops = max(self.stops, message.state.stops)
        elif kind == "feedback":
            told = message.feedback
            if call := self._calls.get(told.number):
                desired, actual = (
                    _sample(*pair)
                    for pair in ((told.joint_desired, told.task_desired), (told.joint_actual, told.task_actual))
                )
                call.feedback.append(Feedback(told.time_s, desired, actual, told.lost, told.path_s, told.path_end_s))
        elif kind == "event":
            told = message.event
            self.events.append(
                Event(self.clock.to_local(told.server_ns), told.name, _named(Code, told.status), told.text)
            )
        elif kind == "parameter_page":
            if call := self._calls.get(message.parameter_page.number):
                call.page = message.parameter_page
        elif kind == "credit":
            self.credit += message.credit.waypoints

    def _take_answer(self, answer: pb.Answer) -> None:
        if answer.number == 0:
            raise Lost(f"{self.address}: the server ends the connection: {answer.text}")
        call = self._calls.get(answer.number)
        if call is None or call.answer is not None:
            why = "twice" if answer.number <= self._number else "that was never sent"
            raise Lost(f"the server has answered request {answer.number} {why}; it does not keep to the protocol")
        call.answer = answer
        self.epoch = max(self.epoch, answer.epoch)
        self.stops = max(self.stops, answer.stops)
        if answer.received_ns:
            stamps = (answer.client_ns, answer.received_ns, answer.server_ns)
            if max(map(abs, stamps)) > _LATEST_NS:
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
        self.reported_ns = report.server_ns
        if call.final:
            del self._calls[report.number]


# --- what a program moves the arm with ---


def connect(
    address: Optional[str] = None,
    *,
    key: Union[str, os.PathLike[str], None] = None,
    name: Optional[str] = None,
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
    timeout_s = _number("timeout_s", timeout_s, 0.01, _LONGEST_WAIT_S)
    lease = pb.Lease(
        wish=pb.Lease.TAKE,
        priority=_whole("priority", priority, 0, 255),
        timeout_ms=_milliseconds("lease_s", lease_s, 0.02, 60),
    )
    subscription = pb.Subscribe(
        state_ms=_milliseconds("state_s", state_s, 0.001, timeout_s),
        feedback_ms=_milliseconds("feedback_s", feedback_s, 0, 60),
        events=True,
    )
    session = _Session(_text("address", address), _text("name", name), timeout_s, key)
    try:
        return Arm(session, lease, subscription)
    except BaseException:
        session.close()
        raise


class Arm:
    """The arm behind a server. The first motion takes the lease; leaving the `with` block gives it back.

    Leaving it by an exception, Ctrl-C among them, cancels what runs: the arm comes to rest on its path. Leaving it
    otherwise lets a trajectory that was begun by `start` run to its end, and waits until all its waypoints are sent.
    """

    def __init__(self, session: _Session, lease: pb.Lease, subscription: pb.Subscribe):
        self._session = session
        self._lease = lease
        self._leased = False
        self._upload = threading.Lock()  # one trajectory at a time is under way to the server
        self._uploading: Optional[Motion] = None
        self.address = session.address
        assert session.welcome
        self.robot = _robot(session.welcome)
        session.ask("subscribe", subscription)

    def __enter__(self) -> Arm:
        return self

    def __exit__(self, kind: Any, error: Any, trace: Any) -> None:
        try:
            if kind is not None and self._leased:
                self._cancel()
            elif self._uploading is not None and self._uploading._thread.ident:
                self._uploading._thread.join()
            if self._leased:
                with contextlib.suppress(Error):
                    self._session.ask("lease", pb.Lease(wish=pb.Lease.RELEASE))
        finally:
            self._session.close()

    def close(self) -> None:
        """Gives the lease back and ends the connection, as leaving the `with` block does."""
        self.__exit__(None, None, None)

    # What it does

    def state(self) -> State:
        """Returns the latest State, at most about `state_s` old, and newer than every result and control so far.

        Raises Lost if the connection has ended.
        """
        told = self._session.wait(self._session.present_state, "State")
        if self._session.broken:
            raise self._session.broken
        return _state(told, self._session.clock)

    def watch(self) -> Iterator[State]:
        """Yields States as they come, until the connection ends; who is too slow sees the latest only."""
        seen: Optional[pb.State] = None
        while True:
            seen = self._session.wait(lambda: self._session.state if self._session.state is not seen else None, "State")
            yield _state(seen, self._session.clock)

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
        q: Optional[ArrayLike] = None,
        dq: Optional[ArrayLike] = None,
        ddq: Optional[ArrayLike] = None,
        tau: Optional[ArrayLike] = None,
        pose: Optional[ArrayLike] = None,
        twist: Optional[ArrayLike] = None,
        acceleration: Optional[ArrayLike] = None,
        wrench: Optional[ArrayLike] = None,
        joints: Optional[Sequence[str]] = None,
        interpolation: str = "by_fields",
        wrap: str = "as_given",
        exact: bool = False,
        start_ns: Optional[int] = None,
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
        terms = self._terms(joints, motion_frame, wrench_frame)
        targets = self._targets(
            dict(q=q, dq=dq, ddq=ddq, tau=tau),
            dict(pose=pose, twist=twist, acceleration=acceleration, wrench=wrench),
            joints,
        )
        numbers, times = np.hstack(list(targets.values())), _real("t", t).astype(float)
        if times.shape != numbers.shape[:1]:
            raise ValueError(f"t has the shape {times.shape}; give one time for each of the {len(numbers)} waypoints")
        kinds = pb.Begin.Interpolation
        if not isinstance(interpolation, str) or interpolation.upper() not in kinds.keys():
            raise ValueError(f"interpolation {interpolation!r}; expected one of {', '.join(kinds.keys()).lower()}")
        wraps = pb.Begin.Wrap
        if not isinstance(wrap, str) or wrap.upper() not in wraps.keys():
            raise ValueError(f"wrap {wrap!r}; expected one of {', '.join(wraps.keys()).lower()}")
        if wraps.Value(wrap.upper()) != pb.Begin.AS_GIVEN and not any(joint.continuous for joint in self.robot.joints):
            raise ValueError(f"wrap {wrap!r}: every joint of {self.robot.name} has stops; leave it out")
        begin = pb.Begin(
            terms=terms,
            wrap=wraps.Value(wrap.upper()),
            interpolation=kinds.Value(interpolation.upper()),
            exact=_flag("exact", exact),
            start_ns=0 if start_ns is None else self._to_server("start_ns", start_ns),
            poses=pose is not None,
            velocities=dq is not None or twist is not None,
            accelerations=ddq is not None or acceleration is not None,
            efforts=tau is not None or wrench is not None,
            check=_flag("check", check),
            window=_whole("window", window, 0, 2**32 - 1),
        )
        if not check:
            self._own()
        return Motion(self, begin, times, numbers)

    def check(self, **trajectory: Any) -> Result:
        """Has the server judge the limits of a trajectory, and moves nothing; needs no lease.

        The outcome is EXECUTED, and `stretch` how much it would be slowed down. Raises Refused with the reason.
        """
        return self.start(check=True, **trajectory).wait()

    def point(self, **target: Any) -> None:
        """Sends one point (what `Stream.send` takes) and returns when it is in force. A trajectory is aborted."""
        with Stream(self, "", "", None) as stream:
            stream.send(**target)

    def velocity(self, **target: Any) -> None:
        """Sends one velocity (what `Stream.velocity` takes) and returns when it is in force."""
        with Stream(self, "", "", None) as stream:
            stream.velocity(**target)

    def stream(
        self, *, motion_frame: str = "", wrench_frame: str = "", joints: Optional[Sequence[str]] = None
    ) -> Stream:
        """Returns a stream of points or velocities at any rate; use it in a `with` statement."""
        return Stream(self, motion_frame, wrench_frame, joints)._open()

    def chunks(
        self,
        *,
        rate_hz: float,
        relative_to: Optional[str] = None,
        crossfade_s: float = 0.2,
        outputs_lead_s: float = 0.0,
        motion_frame: str = "",
        joints: Optional[Sequence[str]] = None,
    ) -> Chunks:
        """Returns a stream of chunks of future targets, as policies give them; use it in a `with` statement.

        rate_hz     -- of the targets within a chunk, 0.001 to 1 000 000
        relative_to -- None: targets are absolute; "commanded": they are added to the reference that the arm had at the
                       time of the observation; "measured": to where the arm was then
        crossfade_s -- 0 to 0.3, in which the difference to the old plan fades, or longer by the limits. 0: as fast
                       as they allow
        outputs_lead_s -- -0.5 to 0.5: by how much digital outputs change before their targets are reached (the latency
                       of a gripper); negative: after they have been passed (the lag of the arm)
        """
        if not self.robot.longest_chunk:
            raise Refused(f"the pipeline {self.robot.pipeline} takes no chunks", 0)
        return Chunks(self, rate_hz, relative_to, crossfade_s, outputs_lead_s, motion_frame, joints)._open()

    # Controls

    def cancel(self) -> None:
        """Ends what runs, whoever moves it; the arm brakes on its path and holds. Raises Refused (42) if nothing runs."""
        self._session.ask("cancel", pb.Cancel())

    def override(self, rate: float) -> None:
        """Lets trajectories pass at this fraction of their speed, 0 to 1, from now on. To raise it needs the lease."""
        request = pb.Override(rate=_number("rate", rate, 0, 1), stops=self._session.stops)
        try:
            self._session.ask("override", request)
        except Refused as refusal:
            if refusal.status != pb.CODE_NOT_OWNER:
                raise
            self._own()
            self._session.ask("override", request)

    def pause(self) -> None:
        """Brings the arm to rest on its path, whoever moves it; the trajectory lives until `resume` or `cancel`."""
        self._session.ask("pause", pb.Pause())

    def resume(self) -> None:
        """Ends a pause."""
        request = pb.Resume(stops=self._session.stops)
        self._own()
        self._session.ask("resume", request)

    def stop(self) -> None:
        """Stops the whole chain, whoever moves it; needs no lease. The arm moves again only after `rearm`."""
        self._session.ask("stop", pb.Stop())

    def rearm(self, within_s: float = 5.0) -> None:
        """Takes over the arm after a stop or a fault, where it is, and returns when it can be moved.

        Waits for `within_s`, 0 to 86 400, until the arm is at rest; otherwise raises Refused with the reason, at once.
        Waits for as long as arming takes (`[executive] arming_ms`). What was sent before is void.
        """
        end = time.monotonic() + _number("within_s", within_s, 0, _LONGEST_WAIT_S)
        request = pb.Rearm(stops=self._session.stops)
        while True:
            self._own()
            call = self._session.send("rearm", request)
            self._session.wait_long(lambda: call.final, "answer to rearm", None)
            if not (refusal := call.refusal()):
                break
            if refusal.status != pb.CODE_NOT_AT_REST or time.monotonic() > end:
                raise refusal
            time.sleep(0.02)
        self._await_nominal(max(1.0, end - time.monotonic()))

    def tare(self) -> Array:
        """Takes a new zero of the force/torque sensor while the arm is controlled, and returns it when it holds.

        Let the arm rest, with nothing in contact. Raises Refused, and the old zero stays, if the zero would move too far,
        which may be a contact (115), if the sensor is not steady in time (75), or if the arm is stopped.
        Returns force and moment at the flange, in its axes: N, N m. Waits for as long as the pipeline gives a tare.
        """
        self._own()
        call = self._session.send("tare", pb.Tare())
        self._session.wait(lambda: call.answer, "answer to tare")
        self._session.wait_long(lambda: call.final, "report of tare", None)
        if refusal := call.refusal():
            raise refusal
        if call.report is None or len(call.report.zero) != 6:
            raise Lost(f"{self._session.address}: the server has reported a tare without its zero")
        return np.array(call.report.zero)

    def parameters(self) -> list[Parameter]:
        """The parameters of the pipeline: present values, units, ranges, and which may change now. Needs no lease."""
        told: list[pb.PresentParameter] = []
        while True:
            page = self._session.page(len(told))
            told += page.parameters
            if not page.parameters or len(told) >= page.total:
                break
        return [
            Parameter(p.section, p.key, p.value, p.unit, p.range, p.file_value or p.value, p.tunable) for p in told
        ]

    def set_parameters(self, values: Mapping[str, Mapping[str, Any]], *, check: bool = False) -> None:
        """Changes parameters of the pipeline, all in one cycle or none: {"pd": {"kp": [100, 100, ...]}}.

        No command steps. Returns when they are in force. Raises Refused with section, key and reason.
        values -- at most 32; texts, or numbers that take at most 191 bytes as such
        check  -- judge them and change nothing; needs no lease
        """
        request = pb.Parameters(check=_flag("check", check))
        for section, keys in values.items():
            _text(f"values: section {reprlib.repr(section)}", section, _BYTES["section"])
            for key, value in keys.items():
                _text(f"values: key {reprlib.repr(key)}", key, _BYTES["key"])
                place = f"values: [{section}] {key}"
                if not isinstance(value, str):
                    value = " ".join(map(repr, _real(place, value).ravel().tolist()))
                request.set.add(section=section, key=key, value=_text(place, value, _BYTES["value"]))
        if len(request.set) > _MOST_PARAMETERS:
            raise ValueError(f"values: {len(request.set)} parameters; at most {_MOST_PARAMETERS} are taken in a set")
        if not check:
            self._own()
        self._session.ask("parameters", request)

    def release(self) -> None:
        """Gives the lease back, if this client has it; what runs goes on to its end."""
        if not self._leased:
            return
        self._session.ask("lease", pb.Lease(wish=pb.Lease.RELEASE))
        self._leased = False

    # Inner parts

    def _own(self) -> int:
        """Takes or renews the lease, and returns the present epoch."""
        epoch = self._session.ask("lease", self._lease).epoch
        self._leased = True
        return epoch

    def _cancel(self) -> None:
        """Cancels what runs, if anything does and the server is still there."""
        with contextlib.suppress(Error):
            self._session.ask("cancel", pb.Cancel())

    def _await_nominal(self, within_s: float) -> None:
        """Waits until the arm is armed and can be moved."""
        session = self._session
        before = session.state

        def told(state: Optional[pb.State]) -> bool:
            return state is not None and state is not before and state.rung <= pb.RUNG_SKIP_OPTIONAL

        with contextlib.suppress(TimeoutError):
            session.wait_long(lambda: told(session.state), "armed arm", within_s)
            return
        state = self.state()
        raise Error(f"the arm is not armed within {within_s:.3g} s; {state.rung!r}, {state.status!r}")

    def _terms(self, joints: Optional[Sequence[str]], motion_frame: str, wrench_frame: str) -> pb.Terms:
        names = [joint.name for joint in self.robot.joints]
        unknown = [name for name in (() if joints is None else joints) if name not in names]
        if unknown:
            raise ValueError(f"joint {unknown[0]!r}; the robot has {', '.join(names)}")
        if joints is not None and not len(joints) == len(set(joints)) > 0:
            raise ValueError(f"joints is {list(joints)!r}; expected one name at least, and each once")
        held = [] if joints is None else [i for i, name in enumerate(names) if name not in joints]
        return pb.Terms(
            held_joints=sum(1 << i for i in held),
            motion_frame=_text("motion_frame", motion_frame, _BYTES["frame"]),
            wrench_frame=_text("wrench_frame", wrench_frame, _BYTES["frame"]),
        )

    def _targets(
        self,
        joint: Mapping[str, Optional[ArrayLike]],
        task: Mapping[str, Optional[ArrayLike]],
        joints: Optional[Sequence[str]],
        rows: tuple[Optional[int], ...] = (None,),
    ) -> dict[str, Array]:
        """Returns the fields that are given, of the joints or of the tip; `rows` is the shape before their width."""
        given = {name: values for name, values in {**joint, **task}.items() if values is not None}
        if ("q" in given) == ("pose" in given):
            raise ValueError("give either q or pose")
        if not (given.keys() <= joint.keys() or given.keys() <= task.keys()):
            raise ValueError("fields of joints and of the tip cannot be mixed")
        targets: dict[str, Array] = {}
        for name, values in given.items():
            targets[name] = self._checked(name, values, joints, rows)
            rows = targets[name].shape[:-1]  # all have as many as the first
        return targets

    def _to_server(self, name: str, local_ns: int) -> int:
        """Returns a stamp of the caller by the clock of the server."""
        return self._session.clock.to_server(_whole(name, local_ns, -_LATEST_NS, _LATEST_NS))

    def _outputs(self, outputs: Optional[Mapping[int, Any]], shape: tuple[int, ...]) -> dict[int, Any]:
        """Returns their values as arrays of that shape; ValueError for one that the robot or its pipeline lacks."""
        checked = {}
        for output, values in (outputs or {}).items():
            if output not in self.robot.outputs:
                known = ", ".join(map(str, self.robot.outputs)) or "none: wire [robot] outputs in the pipeline file"
                raise ValueError(f"outputs: digital output {output!r}; there is {known}")
            expected = f"0 or 1 in the shape {shape}" if shape else "0 or 1"
            array = _real(f"outputs[{output}]", values, expected)
            if array.shape != shape or not np.isin(array, (0, 1)).all():
                raise ValueError(f"outputs[{output}] is {reprlib.repr(values)}; expected {expected}")
            checked[int(output)] = array.astype(bool)
        return checked

    def _checked(
        self, name: str, values: ArrayLike, joints: Optional[Sequence[str]], rows: tuple[Optional[int], ...]
    ) -> Array:
        """Returns a field as an array for all joints, or for the tip; ValueError if its shape is wrong."""
        width = _TASK_WIDTHS.get(name, self.robot.dof if joints is None else len(joints))
        array, shape = _real(name, values).astype(float), (*rows, width)
        if array.ndim != len(shape) or any(e not in (None, n) for n, e in zip(array.shape, shape)):
            expected = ", ".join("n" if size is None else str(size) for size in shape)
            raise ValueError(f"{name} has the shape {array.shape}; expected ({expected})")
        if name in _TASK_WIDTHS or joints is None:
            return array
        names = [joint.name for joint in self.robot.joints]
        wide = np.zeros((*array.shape[:-1], len(names)))
        wide[..., [names.index(name) for name in joints]] = array
        return wide


class Motion:
    """A trajectory that the server has accepted. Iterate over it for feedback, or `wait` for its end.

    Ctrl-C in either cancels it, on its path, and raises KeyboardInterrupt.
    """

    def __init__(self, arm: Arm, begin: pb.Begin, times: Array, numbers: Array):
        self._arm, self._session = arm, arm._session
        self._times, self._numbers = times, numbers
        self._sent = 0
        self._thread = threading.Thread(target=self._feed, name="tactus waypoints", daemon=True)
        with self._on_interrupt():
            with arm._upload:
                arm._uploading = self
                self._call = self._session.send("begin", begin)
            self._session.wait(lambda: self._call.answer, "answer to begin")
            if refusal := self._call.refusal():
                raise refusal
            self._thread.start()
            self._await_verdict()
        if refusal := self._call.refusal():
            raise refusal

    @property
    def result(self) -> Optional[Result]:
        """How it has ended; None while it runs."""
        told = self._call.report
        if told is None or not Outcome(told.outcome).final:
            return None
        return Result(Outcome(told.outcome), _named(Code, told.status), told.text, told.time_s, told.stretch)

    def wait(self, timeout_s: Optional[float] = None) -> Result:
        """Waits for the end, and returns the Result if it succeeded, was preempted or canceled.

        Raises Aborted if the robot gave it up, Refused if a later waypoint was not accepted, Lost if the connection
        ends; TimeoutError after `timeout_s`, 0 to 86 400, if given: the trajectory goes on.
        """
        if timeout_s is not None:
            timeout_s = _number("timeout_s", timeout_s, 0, _LONGEST_WAIT_S)
        with self._on_interrupt():
            result = self._session.wait_long(lambda: self.result, "end of the trajectory", timeout_s)
        if refusal := self._call.refusal():
            raise refusal
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
        """Ends it on its path and returns its Result, also if it has ended before."""
        if self.result is None:
            try:
                self._arm.cancel()
            except Refused:
                if self.result is None:
                    raise
        return self.wait()

    @contextlib.contextmanager
    def _on_interrupt(self) -> Iterator[None]:
        try:
            yield
        except KeyboardInterrupt:
            self._arm._cancel()
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
        robot = self._arm.robot
        part = min(robot.longest_part, (_LONGEST_MESSAGE - 64) // (8 * (self._numbers.shape[1] + 1)))
        with contextlib.suppress(Error):  # the call that waits for the motion raises it
            while True:
                done = self._sent == len(self._times)
                if not done:
                    self._session.wait_long(lambda: self._session.credit > 0 or self._call.final, "Credit", None)
                with self._arm._upload:
                    if self._arm._uploading is not self or self._call.final:
                        return
                    if done:
                        self._session.send("end", pb.End())
                        return
                    with self._session.news:
                        count = min(part, self._session.credit, len(self._times) - self._sent)
                        self._session.credit -= count
                    rows = slice(self._sent, self._sent + count)
                    self._session.send(
                        "part", pb.Part(time_s=self._times[rows].tolist(), numbers=self._numbers[rows].ravel().tolist())
                    )
                    self._sent += count


class _References:
    """References that follow each other, each with its place in the stream, and what has become of them."""

    def __init__(self, arm: Arm, motion_frame: str, wrench_frame: str, joints: Optional[Sequence[str]]):
        self._arm, self._session = arm, arm._session
        self._terms, self._joints = arm._terms(joints, motion_frame, wrench_frame), joints
        self._epoch: Optional[int] = None
        self._calls: collections.deque[_Call] = collections.deque()

    def _open(self: Self) -> Self:
        """Takes the lease and the present epoch, if it has not yet."""
        if self._epoch is None:
            self._epoch = self._arm._own()
        return self

    def __enter__(self: Self) -> Self:
        return self

    def __exit__(self, kind: Any, error: Any, trace: Any) -> None:
        if kind is None:
            self._collect(0)
        elif self._epoch is not None:
            self._arm._cancel()

    def _send(self, kind: str, request: Any) -> None:
        self._open()
        self._collect(_UNREPORTED)
        if self._session.epoch != self._epoch:
            raise Stopped("the arm was stopped since this stream was opened; rearm and open a new stream to go on")
        request.terms.CopyFrom(self._terms)
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

    def _judge(self, call: _Call) -> None:
        if refusal := call.refusal():
            if self._session.epoch != self._epoch:
                raise Stopped(str(refusal)) from refusal
            raise refusal
        if call.report is not None and Outcome(call.report.outcome) in (Outcome.ABORTED, Outcome.CANCELED):
            raise Stopped(call.report.text or "the motion of this stream was canceled; open a new stream to go on")


class Stream(_References):
    """A stream of points or velocities at any rate. The newest wins; the server keeps the arm within its limits.

    A `send` does not wait for the server; what it refuses is raised by the next `send`, or at the end of the `with`
    block. Leaving the block by an exception cancels the motion; otherwise the arm goes to the last point.
    """

    def send(
        self,
        *,
        q: Optional[ArrayLike] = None,
        dq: Optional[ArrayLike] = None,
        ddq: Optional[ArrayLike] = None,
        tau: Optional[ArrayLike] = None,
        pose: Optional[ArrayLike] = None,
        twist: Optional[ArrayLike] = None,
        acceleration: Optional[ArrayLike] = None,
        wrench: Optional[ArrayLike] = None,
        outputs: Optional[Mapping[int, bool]] = None,
        sent_ns: int = 0,
    ) -> None:
        """Sends a point: q and what goes with it, [joints], or pose and what goes with it, [7] and [6].

        With dq or twist the arm passes the point at that velocity and comes to rest if no other follows.
        outputs -- digital outputs, set when the point takes effect; the others are left alone
        sent_ns -- when the device was read, by any clock that does not step, `time.monotonic_ns()` for example: the arm
            follows the stream smoothly although some of its points come late or not at all
        """
        targets = self._arm._targets(
            dict(q=q, dq=dq, ddq=ddq, tau=tau),
            dict(pose=pose, twist=twist, acceleration=acceleration, wrench=wrench),
            self._joints,
            rows=(),
        )
        point = pb.Point(sent_ns=_whole("sent_ns", sent_ns, -(2**63), 2**63 - 1))
        for output, on in self._arm._outputs(outputs, ()).items():
            point.outputs_mask |= 1 << output
            point.outputs |= int(on) << output
        for name, numbers in targets.items():
            getattr(point.task if name in _TASK_WIDTHS else point.joint, name).extend(numbers.tolist())
        self._send("point", point)

    def velocity(
        self, *, dq: Optional[ArrayLike] = None, twist: Optional[ArrayLike] = None, timeout_s: float = 0.2
    ) -> None:
        """Sends velocities of the joints, [joints] rad/s, or of the tip, [6] m/s and rad/s, to keep until the next.

        timeout_s -- 0.001 to 10: if nothing follows for as long, the arm comes to rest
        """
        if (dq is None) == (twist is None):
            raise ValueError("give either dq or twist")
        request = pb.Velocity(timeout_ms=_milliseconds("timeout_s", timeout_s, 0.001, 10))
        if dq is not None:
            request.dq.extend(self._arm._checked("dq", dq, self._joints, ()).tolist())
        if twist is not None:
            request.twist.extend(self._arm._checked("twist", twist, self._joints, ()).tolist())
        self._send("velocity", request)


class Chunks(_References):
    """Chunks of future targets. Each replaces the plan from its first target that is still ahead, smoothly.

    A chunk that is late as a whole is no error: `late` counts them, `late_s` is by how much the newest of them came
    after its last target, and the old plan goes on. If all of a second are late, there is a warning. The arm comes to
    rest when the targets run out, unless a new chunk comes before.
    """

    def __init__(
        self,
        arm: Arm,
        rate_hz: float,
        relative_to: Optional[str],
        crossfade_s: float,
        outputs_lead_s: float,
        motion_frame: str,
        joints: Optional[Sequence[str]],
    ):
        super().__init__(arm, motion_frame, "", joints)
        bases = {None: pb.Chunk.NONE, "commanded": pb.Chunk.COMMANDED, "measured": pb.Chunk.MEASURED}
        if not isinstance(relative_to, (str, type(None))) or relative_to not in bases:
            raise ValueError(f"relative_to {relative_to!r}; expected None, 'commanded' or 'measured'")
        self._base = bases[relative_to]
        self._rate_hz = _number("rate_hz", rate_hz, 1e-3, 1e6)
        self._crossfade_s = _number("crossfade_s", crossfade_s, 0, 0.3)
        self._outputs_lead_s = _number("outputs_lead_s", outputs_lead_s, -0.5, 0.5)
        self.late, self.late_s = 0, 0.0
        self._late_since: Optional[float] = None

    def send(
        self,
        q: Optional[ArrayLike] = None,
        *,
        pose: Optional[ArrayLike] = None,
        dq: Optional[ArrayLike] = None,
        twist: Optional[ArrayLike] = None,
        observed_ns: Optional[int] = None,
        first: int = 0,
        ends: bool = False,
        outputs: Optional[Mapping[int, ArrayLike]] = None,
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
        targets = self._arm._targets(dict(q=q, dq=dq), dict(pose=pose, twist=twist), self._joints)
        count = len(next(iter(targets.values())))
        if count > self._arm.robot.longest_chunk:
            raise ValueError(f"{count} targets; the server takes {self._arm.robot.longest_chunk} in a chunk")
        if observed_ns is None and self._base != pb.Chunk.NONE:
            raise ValueError("observed_ns is missing; relative targets count from the state at an observation")
        first = _number("first", first, -1e6, 1e6)
        chunk = pb.Chunk(
            base=self._base,
            ends=_flag("ends", ends),
            crossfade_s=self._crossfade_s,
            time_s=((first + np.arange(count)) / self._rate_hz).tolist(),
            time=pb.Chunk.ON_ARRIVAL if observed_ns is None else pb.Chunk.ABSOLUTE,
            outputs_lead_s=self._outputs_lead_s,
        )
        for output, values in self._arm._outputs(outputs, (count,)).items():
            chunk.channels.add(output=output, values=values.tolist())
        if len(chunk.channels) > _MOST_CHANNELS:
            raise ValueError(f"outputs: {len(chunk.channels)} of them; at most {_MOST_CHANNELS} are taken in a chunk")
        if observed_ns is not None:
            chunk.origin_ns = chunk.observed_ns = self._arm._to_server("observed_ns", observed_ns)
        for name, numbers in targets.items():
            getattr(chunk, name).extend(numbers.ravel().tolist())
        self._send("chunk", chunk)

    def _judge(self, call: _Call) -> None:
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


# --- a simulated robot ---


@contextlib.contextmanager
def serve(
    pipeline: Union[str, os.PathLike[str]],
    *,
    program: Union[str, os.PathLike[str], None] = None,
    options: Sequence[str] = (),
) -> Iterator[str]:
    """Runs a server with a simulated robot on a private socket, and yields its address. The server ends with the block.

    The robot moves at the pace of the wall clock; on a busy machine it waits instead of being braked for late cycles.

    pipeline -- a pipeline file
    program  -- a program of a simulated board; None: build/<robot>_sim/tactus beside the folder of the pipeline file
    options  -- further options of `tactus serve`
    """
    file = pathlib.Path(pipeline).resolve()
    program = _program_for(file) if program is None else pathlib.Path(program).resolve()
    with (
        tempfile.TemporaryDirectory(prefix="tactus-", ignore_cleanup_errors=True) as folder,
        open(f"{folder}/log", "w+", encoding="utf-8", errors="replace") as log,  # not a pipe, which would fill
    ):
        address = f"unix:{folder}/socket"
        try:
            server = subprocess.Popen(
                [program, "serve", file, "--virtual-time", "--listen", address, *options],
                cwd=folder,
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=log,
            )
        except OSError as error:
            raise ValueError(f"program {program}: {error.strerror}") from error
        try:
            _await_server(server, address, log)
            yield address
        finally:
            server.terminate()
            try:
                server.wait(10)
            except subprocess.TimeoutExpired:
                server.kill()
                server.wait()


@contextlib.contextmanager
def sim(pipeline: Union[str, os.PathLike[str]], **settings: Any) -> Iterator[Arm]:
    """Runs a simulated robot for the `with` block and yields its Arm; takes what `serve` takes."""
    with serve(pipeline, **settings) as address, connect(address) as arm:
        yield arm


def _program_for(pipeline: pathlib.Path) -> pathlib.Path:
    """Returns the program of the simulated board for the robot that a pipeline file names."""
    try:
        lines = pipeline.read_text(encoding="utf-8", errors="replace").partition("[robot]")[2].splitlines()
    except OSError as error:
        raise ValueError(f"pipeline {pipeline}: {error.strerror}") from error
    robot = next(
        (line.partition("=")[2].split("#")[0].strip() for line in lines if line.split("=")[0].strip() == "name"), ""
    )
    tried = [folder / f"build/{robot}_sim/tactus" for folder in pipeline.parents]
    found = next((program for program in tried if robot and program.exists()), None)
    if found is None:
        raise Error(f"{pipeline}: no build/{robot}_sim/tactus above it; run `make BOARD={robot}_sim`, or give program=")
    return found


def _await_server(
    server: subprocess.Popen[bytes], address: str, log: Any, key: Union[str, os.PathLike[str], None] = None
) -> None:
    """Waits until the server takes clients and its arm is armed."""
    end = time.monotonic() + 20.0
    while server.poll() is None and time.monotonic() < end:
        with contextlib.suppress(Lost), connect(address, key=key) as arm:
            arm._await_nominal(20.0)
            return
        time.sleep(0.01)
    log.seek(0)
    raise Lost(f"the simulated robot did not start: {log.read().strip() or 'it says nothing'}")


def _robot(welcome: pb.Welcome) -> Robot:
    fields = ("name", "min_rad", "max_rad", "velocity", "acceleration", "jerk", "effort", "continuous")
    joints = tuple(Joint(*(getattr(joint, field) for field in fields)) for joint in welcome.joints)
    return Robot(
        welcome.board,
        welcome.robot,
        welcome.pipeline,
        welcome.configuration,
        welcome.period_s,
        joints,
        welcome.takes_joints,
        welcome.takes_poses,
        welcome.longest_chunk,
        welcome.window,
        welcome.longest_part,
        _outputs(welcome),
    )


def _outputs(welcome: pb.Welcome) -> Mapping[int, str]:
    offered = [i for i in range(32) if welcome.outputs >> i & 1]
    return dict(zip(offered, list(welcome.output_names) or [""] * len(offered)))


def _state(told: pb.State, clock: _Clock) -> State:
    copied = {field.name: getattr(told, field.name) for field in dataclasses.fields(State) if hasattr(told, field.name)}
    for name, kind in {"rung": Rung, "status": Code, "phase": Phase}.items():
        copied[name] = _named(kind, copied[name])
    for name, value in copied.items():
        if name in ("q", "dq", "tau", "q_d", "dq_d", "pose", "pose_d", "wrench"):
            copied[name] = _array(value)
    copied["outputs"] = {i: bool(told.outputs >> i & 1) for i in range(32) if told.outputs_mask >> i & 1}
    counts = told.stream
    return State(
        stamp_ns=clock.to_local(told.server_ns),
        chunks_taken=counts.taken,
        chunks_late=counts.late,
        chunks_dropped=counts.dropped,
        targets_trimmed=counts.trimmed,
        seam=counts.seam,
        **copied,
    )
