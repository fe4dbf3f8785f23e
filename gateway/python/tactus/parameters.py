"""Parameters of the pipeline that runs."""

import dataclasses
import reprlib
from typing import Any, Mapping

import numpy as np

from . import tactus_pb2 as pb
from .arguments import real, text
from .connection import Session
from .errors import Lost
from .protocol import Array, copied

_LONGEST_NAME, _LONGEST_VALUE, _MOST = 31, 191, 32  # bytes, bytes, parameters of a set; gateway/tactus.options


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
        """The value as numbers, [1] if it is the same for all joints. Raises ValueError if it is a word."""
        return np.array(self.value.split(), dtype=float)


def listed(session: Session) -> list[Parameter]:
    told: list[Parameter] = []
    while True:
        page = session.ask("list_parameters", pb.ListParameters(first=len(told))).page
        if page is None:
            raise Lost(f"{session.address}: the server has answered without the page of parameters")
        told += (copied(Parameter, p, file_value=p.file_value or p.value) for p in page.parameters)
        if not page.parameters or len(told) >= page.total:
            return told


def request_of(values: Mapping[str, Mapping[str, Any]]) -> pb.Parameters:
    """Returns the request that sets these values; ValueError if a text is too long or a value is none."""
    request = pb.Parameters()
    for section, keys in values.items():
        text(f"values: section {reprlib.repr(section)}", section, _LONGEST_NAME)
        for key, value in keys.items():
            text(f"values: key {reprlib.repr(key)}", key, _LONGEST_NAME)
            place = f"values: [{section}] {key}"
            if not isinstance(value, str):
                value = " ".join(map(repr, real(place, value).ravel().tolist()))
            request.set.add(section=section, key=key, value=text(place, value, _LONGEST_VALUE))
    if len(request.set) > _MOST:
        raise ValueError(f"values: {len(request.set)} parameters; at most {_MOST} are taken in a set")
    return request
