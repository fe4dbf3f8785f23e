"""Checks of what a caller gives: a ValueError names the argument, its value and what is expected."""

import os
import reprlib
from typing import Any, Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import tactus_pb2 as pb
from .messages import RobotDescription
from .protocol import LONGEST_FRAME, LONGEST_MESSAGE, Array

TASK_WIDTHS = {"pose": 7, "twist": 6, "acceleration": 6, "wrench": 6}

Path = str | os.PathLike[str]


def real(name: str, values: Any, expected: str = "real numbers") -> NDArray[Any]:
    """Returns them as an array; ValueError if they are anything else, texts or complex numbers for example."""
    cause: Exception | None = None
    try:
        array = np.asarray(values)
        if array.dtype.kind in "biuf":
            return array
    except Exception as error:  # of whatever kind: values of other libraries convert themselves
        cause = error
    raise ValueError(f"{name} is {reprlib.repr(values)}; expected {expected}") from cause


def number(name: str, value: Any, low: float, high: float, is_whole: bool = False) -> Any:
    """Returns it as a number of Python; ValueError if it is not one from `low` to `high`."""
    expected = f"a {'whole ' * is_whole}number from {low:.10g} to {high:.10g}"
    found = real(name, value, expected)
    if found.ndim or not low <= found.item() <= high or (is_whole and found % 1):
        raise ValueError(f"{name} is {reprlib.repr(value)}; expected {expected}")
    return found.item()


def whole(name: str, value: Any, low: int, high: int) -> int:
    return int(number(name, value, low, high, is_whole=True))


def flag(name: str, value: Any) -> bool:
    return bool(whole(name, value, 0, 1))


def milliseconds(name: str, value_s: Any, low_s: float, high_s: float) -> int:
    return round(1000 * float(number(name, value_s, low_s, high_s)))


def text(name: str, value: Any, most: int = LONGEST_MESSAGE) -> str:
    """Returns it; ValueError if it is no text, or longer than `most` bytes."""
    try:
        size = len(value.encode())
    except (AttributeError, UnicodeError) as error:
        raise ValueError(f"{name} is {reprlib.repr(value)}; expected a text") from error
    if size > most:
        raise ValueError(f"{name} has {size} bytes; at most {most} are taken")
    return str(value)


def member(name: str, value: Any, kinds: Any) -> Any:
    """Returns the number of a name in an enumeration of the protocol, as users write it: in small letters."""
    if not isinstance(value, str) or value.upper() not in kinds.keys():
        raise ValueError(f"{name} {value!r}; expected one of {', '.join(kinds.keys()).lower()}")
    return kinds.Value(value.upper())


class Targets:
    """Checks the targets of one trajectory or stream: what is wrong is a ValueError."""

    def __init__(
        self,
        robot: RobotDescription,
        joints: Sequence[str] | None = None,
        motion_frame: str = "",
        wrench_frame: str = "",
    ):
        self._robot = robot
        names = [joint.name for joint in robot.joints]
        moved = names if joints is None else list(joints)
        unknown = [name for name in moved if name not in names]
        if unknown:
            raise ValueError(f"joint {unknown[0]!r}; the robot has {', '.join(names)}")
        if joints is not None and not len(moved) == len(set(moved)) > 0:
            raise ValueError(f"joints is {moved!r}; expected one name at least, and each once")
        self._columns = [names.index(name) for name in moved]
        self.terms = pb.Terms(
            held_joints=sum(1 << i for i in range(robot.dof) if i not in self._columns),
            motion_frame=text("motion_frame", motion_frame, LONGEST_FRAME),
            wrench_frame=text("wrench_frame", wrench_frame, LONGEST_FRAME),
        )

    def read(self, rows: tuple[int | None, ...], **fields: ArrayLike | None) -> dict[str, Array]:
        """Returns the fields that are given, of the joints or of the tip; `rows` is the shape before their width."""
        given = {name: values for name, values in fields.items() if values is not None}
        if ("q" in given) == ("pose" in given):
            raise ValueError("give either q or pose")
        if len({name in TASK_WIDTHS for name in given}) > 1:
            raise ValueError("fields of joints and of the tip cannot be mixed")
        targets: dict[str, Array] = {}
        for name, values in given.items():
            targets[name] = self.field(name, values, rows)
            rows = targets[name].shape[:-1]  # all have as many as the first
        return targets

    def field(self, name: str, values: ArrayLike, rows: tuple[int | None, ...] = ()) -> Array:
        """Returns a field as an array for all joints, or for the tip. None among the `rows` is any number of them."""
        width = TASK_WIDTHS.get(name, len(self._columns))
        array, shape = real(name, values).astype(float), (*rows, width)
        if array.ndim != len(shape) or any(e not in (None, n) for n, e in zip(array.shape, shape)):
            expected = ", ".join("n" if size is None else str(size) for size in shape)
            raise ValueError(f"{name} has the shape {array.shape}; expected ({expected})")
        if name in TASK_WIDTHS:
            return array
        wide = np.zeros((*array.shape[:-1], self._robot.dof))
        wide[..., self._columns] = array
        return wide

    def outputs(self, outputs: Mapping[int, Any] | None, shape: tuple[int, ...] = ()) -> dict[int, Any]:
        """Returns the values of digital outputs as arrays of that shape."""
        checked = {}
        for output, values in (outputs or {}).items():
            if output not in self._robot.outputs:
                known = ", ".join(map(str, self._robot.outputs)) or "none: wire [robot] outputs in the pipeline file"
                raise ValueError(f"outputs: digital output {output!r}; there is {known}")
            expected = f"0 or 1 in the shape {shape}" if shape else "0 or 1"
            array = real(f"outputs[{output}]", values, expected)
            if array.shape != shape or not np.isin(array, (0, 1)).all():
                raise ValueError(f"outputs[{output}] is {reprlib.repr(values)}; expected {expected}")
            checked[int(output)] = array.astype(bool)
        return checked
