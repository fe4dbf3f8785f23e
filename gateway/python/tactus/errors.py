"""The errors of this library that are not mistakes of the caller."""

from . import tactus_pb2 as pb
from .messages import Result
from .protocol import Code, named


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

    def __init__(self, text: str, status: int, finding: pb.Finding | None = None):
        super().__init__(f"{text} ({int(status)})" if f"({int(status)})" not in text else text)
        self.status = named(Code, status)
        reason, _, self.remedy = text.partition("; ")
        self.place = reason.partition(": ")[0] if ": " in reason else ""
        self.waypoint = finding.waypoint if finding is not None and finding.waypoint >= 0 else None
        self.axis = finding.axis if finding is not None and finding.axis >= 0 else None
        self.value, self.limit = (None, None) if finding is None else (finding.value, finding.limit)


class Aborted(Error):
    """A trajectory was given up by the robot: a tolerance was violated, or a fault brakes the arm. `result` has it."""

    def __init__(self, result: Result):
        super().__init__(result.text or f"aborted ({int(result.status)})")
        self.result = result


class Stopped(Error):
    """A stop has made the stream void that this reference belongs to; open a new stream to go on."""
