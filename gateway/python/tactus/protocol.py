"""What the protocol says in numbers: names of enumerations, limits of messages, and copies of messages."""

import dataclasses
import enum
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from . import tactus_pb2 as pb

LONGEST_MESSAGE = 16 * 1024  # bytes; tactus.proto
LONGEST_FRAME = 63  # bytes of the name of a frame; docs/gateway.md, gateway/tactus.options
LATEST_NS = 2**61  # of a clock, 73 years: the sum of two fits in 64 bits
LONGEST_WAIT_S = 86400.0

Array = NDArray[np.float64]
T = TypeVar("T")


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
        """Nothing more is to come."""
        return self >= Outcome.SUCCEEDED


def _names(name: str, numbers: Any, meaning: str) -> Any:
    """Returns an enumeration of the protocol; its names lose what they begin with there: RUNG_HOLD is HOLD."""
    prefix = f"{name.upper()}_"
    names = {key.removeprefix(prefix): number for key, number in numbers.items()}
    kind = enum.IntEnum(name, names, module=__name__)  # type: ignore[misc]  # its names are those of the protocol
    kind.__doc__ = f"{meaning}, as in tactus.proto."
    return kind


Rung = _names("Rung", pb.Rung, "The ladder by which the arm stops in stages: NOMINAL, ...")
Phase = _names("Phase", pb.Phase, "The phase of the motion: HOLDING, FOLLOWING, PAUSED, ...")
Code = _names("Code", pb.Code, "Why something was refused, ended or stopped: OK, VELOCITY_LIMIT, ...")


def named(kind: Any, number: int) -> int:
    """Returns the member with this number; the number itself if a newer server has sent one without a name."""
    member: int = kind(number) if number in kind.__members__.values() else number
    return member


def copied(kind: type[T], message: Any, **others: Any) -> T:
    """Returns a dataclass with the fields of a message; `others` are those that it has not, or has otherwise."""
    names = {field.name for field in dataclasses.fields(kind)} - others.keys()
    return kind(**others, **{name: getattr(message, name) for name in names})
