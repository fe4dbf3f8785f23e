"""Reads recordings: the MCAP files of `tactus run --record` and `tactusctl record`.

    python3 -m tactus.recording take.mcap > take.csv

prints the trajectory of a recording, which `tactus run --trajectory` takes: of a run its whole log, bit for bit, since
a log is a trajectory; of a server the references of its States.
"""

import math
import pathlib
import re
import struct
import sys
import zlib
from typing import Any, Iterator, NamedTuple

from google.protobuf import descriptor_pb2, descriptor_pool, message, message_factory

from .errors import Error

MAGIC = b"\x89MCAP0\r\n"
POSE = ("x", "y", "z", "qw", "qx", "qy", "qz")
SCHEMA, CHANNEL, MESSAGE, CHUNK, STATISTICS, DATA_END = 0x03, 0x04, 0x05, 0x06, 0x0B, 0x0F  # what is read; mcap.dev/spec
# What decoding damaged or foreign records raises.
DAMAGED = struct.error, KeyError, IndexError, TypeError, ValueError, message.DecodeError


class Message(NamedTuple):
    """A message of a recording, decoded by the schema in the file."""

    topic: str
    time_ns: int
    value: Any


def records(data: bytes, offset: int) -> Iterator[tuple[int, bytes]]:
    """Yields opcode and content of every record, up to the first that is cut off."""
    while offset + 9 <= len(data):
        op, size = struct.unpack_from("<BQ", data, offset)
        offset += 9 + size
        if offset > len(data):
            return
        yield op, data[offset - size : offset]


def strings(content: bytes, offset: int, count: int) -> list[bytes]:
    """Returns so many strings, each behind its size."""
    found = []
    for _ in range(count):
        (size,) = struct.unpack_from("<I", content, offset)
        found.append(content[offset + 4 : offset + 4 + size])
        offset += 4 + size
    return found


class Recording:
    """The messages of an MCAP file with protobuf schemas. Iterate over it: they come in the order of the file.

    channels -- topics that have been read, and the classes of their messages
    whole    -- False, once all messages have been read: the file was cut off, and its last chunk is missing
    """

    def __init__(self, path: str | pathlib.Path):
        self.path, self.whole = path, False
        self.channels: dict[str, Any] = {}
        self._data = pathlib.Path(path).read_bytes()
        self._kinds: dict[int, Any] = {}
        self._topics: dict[int, str] = {}
        if not self._data.startswith(MAGIC):
            raise Error(f"{path}: no MCAP file; give one of tactus run --record or tactusctl record")

    def __iter__(self) -> Iterator[Message]:
        try:
            yield from self._messages()
        except DAMAGED as error:
            raise Error(f"{self.path}: damaged, or not written by tactus: {type(error).__name__}: {error}") from error

    def _messages(self) -> Iterator[Message]:
        count = 0
        for op, content in records(self._data, len(MAGIC)):
            if op == DATA_END:
                self.whole = True
            elif op == STATISTICS and struct.unpack_from("<Q", content)[0] != count:
                raise Error(f"{self.path}: holds {count} of {struct.unpack_from('<Q', content)[0]} messages; a part was taken out")
            if self.whole:
                continue
            inside = records(self._chunk(content), 0) if op == CHUNK else [(op, content)]
            for each, body in inside:
                if each == SCHEMA:
                    self._add_schema(body)
                elif each == CHANNEL:
                    self._add_channel(body)
                elif each == MESSAGE:
                    channel, _, time_ns, _ = struct.unpack_from("<HIQQ", body)
                    topic = self._topics[channel]
                    count += 1
                    yield Message(topic, time_ns, self.channels[topic].FromString(body[22:]))

    def _chunk(self, content: bytes) -> bytes:
        """Returns the records of a chunk."""
        (crc,) = struct.unpack_from("<I", content, 24)
        (compression,) = strings(content, 28, 1)
        inside = content[40 + len(compression) :]
        if compression:
            raise Error(f"{self.path}: chunks are compressed ({compression.decode()}); rewrite it without compression")
        if crc and crc != zlib.crc32(inside):
            raise Error(f"{self.path}: the check sum of a chunk is wrong; the file was changed after it was written")
        return inside

    def _add_schema(self, content: bytes) -> None:
        name, encoding, data = strings(content, 2, 3)
        if encoding != b"protobuf":
            raise Error(f"{self.path}: {name.decode()} has a schema of {encoding.decode()}; only protobuf is read")
        pool = descriptor_pool.DescriptorPool()
        for file in descriptor_pb2.FileDescriptorSet.FromString(data).file:
            pool.Add(file)
        kind = pool.FindMessageTypeByName(name.decode())
        made = getattr(message_factory, "GetMessageClass", None) or message_factory.MessageFactory().GetPrototype
        self._kinds[struct.unpack_from("<H", content)[0]] = made(kind)

    def _add_channel(self, content: bytes) -> None:
        channel, schema = struct.unpack_from("<HH", content)
        self._topics[channel] = topic = strings(content, 4, 1)[0].decode()
        if schema not in self._kinds:
            raise Error(f"{self.path}: {topic} has no schema; only protobuf is read")
        self.channels[topic] = self._kinds[schema]


def is_output(kind: Any) -> bool:
    """Returns whether messages are a time_s and other single numbers."""
    fields = kind.DESCRIPTOR.fields
    return fields[0].name == "time_s" and all(f.type == f.TYPE_DOUBLE and f.label != f.LABEL_REPEATED for f in fields) if fields else False


def rows_of_run(recording: Recording) -> Iterator[list[str]]:
    """Yields the lines of log.csv as cells: the header, and one row for each time at which outputs were recorded."""
    names: list[str] = []
    row: list[str] = []
    time_s = last_s = -math.inf
    for message in recording:
        if not names:
            outputs = {topic: kind for topic, kind in recording.channels.items() if is_output(kind)}
            columns = {topic: [field.name for field in kind.DESCRIPTOR.fields][1:] for topic, kind in outputs.items()}
            names = [f"{topic}_{re.sub('^joint', '', name)}" for topic in columns for name in columns[topic]]
            yield ["time_s", *names]
        if message.topic not in columns:
            continue
        if not row:
            time_s = message.value.time_s
            row = [repr(time_s)]
        if message.value.time_s != time_s or not last_s < time_s < math.inf:
            raise Error(f"{recording.path}: {message.topic} at {message.value.time_s} s, after {last_s} s: rows are incomplete, or "
                        "not in order; a part was taken out or moved")
        row += [repr(getattr(message.value, name)) for name in columns[message.topic]]
        if len(row) > len(names):
            yield row
            row, last_s = [], time_s


def rows_of_server(recording: Recording) -> Iterator[list[str]]:
    """Yields a header, as of a log, and the references of the States, from time 0 on."""
    begin_ns = last_ns = None
    for topic, time_ns, state in recording:
        if topic != "/state" or time_ns == last_ns:
            continue
        numbers = [*state.q_d, *state.dq_d] or state.pose_d
        if begin_ns is None:
            begin_ns = time_ns
            joints = range(1, len(state.q_d) + 1)
            names = [f"{name}_{i}" for name in ("q_d", "dq_d") for i in joints] or [f"x_d_{axis}" for axis in POSE]
            yield ["time_s", *(f"state.{name}" for name in names)]
        last_ns = time_ns
        yield [repr((time_ns - begin_ns) * 1e-9), *map(repr, numbers)]


def rows(recording: Recording) -> Iterator[list[str]]:
    """Yields the trajectory of a recording as the cells of a CSV file, its header first."""
    next(iter(recording), None)
    state = recording.channels.get("/state")
    if state is not None and state.DESCRIPTOR.full_name == "tactus.State":
        return rows_of_server(recording)
    if any(map(is_output, recording.channels.values())):
        return rows_of_run(recording)
    raise Error(f"{recording.path}: no trajectory: it has neither outputs of a run, topics like jrg.q_d whose messages "
                "have time_s, nor /state of a server; record with tactus run --record or tactusctl record")


def main() -> None:
    """Prints the trajectory of the recording that the command line names."""
    try:
        recording = Recording(sys.argv[1])
        for row in rows(recording):
            print(",".join(row))
    except Error as error:
        sys.exit(str(error))
    except OSError as error:
        sys.exit(f"{error.filename}: {error.strerror}; give one of tactus run --record or tactusctl record")
    except IndexError:
        sys.exit("usage: python3 -m tactus.recording FILE.mcap > FILE.csv")
    if not recording.whole:
        print(f"{recording.path}: was cut off; its last second may be missing", file=sys.stderr)


if __name__ == "__main__":
    main()
