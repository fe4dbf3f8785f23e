#!/usr/bin/python3
"""judge_recording.py RECORDING [LOG]: judges an MCAP file by the specification at mcap.dev/spec, and prints its events.

Every record, check sum, index and number of the summary is computed anew from the bytes of the file; messages are
decoded by the schemas in it. With LOG, the log.csv of the same run, values are compared bit for bit. Then the file is
cut at 30 random places, and tactus.recording must read exactly the messages of the whole chunks that are left; then
bytes are changed, and a chunk is taken out.
"""

import collections
import pathlib
import random
import struct
import sys
import tempfile
import zlib

from google.protobuf import descriptor_pb2, descriptor_pool, message_factory
from tactus.errors import Error
from tactus.recording import Recording, rows

MAGIC = bytes([0x89]) + b"MCAP0\r\n"
HEADER, FOOTER, SCHEMA, CHANNEL, MESSAGE, CHUNK, INDEX, CHUNK_INDEX, STATISTICS, OFFSET, DATA_END = (
    1, 2, 3, 4, 5, 6, 7, 8, 0x0B, 0x0E, 0x0F)
COUNTS = {"H": 2, "I": 4, "Q": 8, "B": 1}


def fields(content, *kinds):
    """Takes a content apart: numbers as struct names them, "s" a string or bytes, "t" an array of (Q, Q), "m" one of (H, Q)."""
    at, found = 0, []
    for kind in kinds:
        if kind in COUNTS:
            found += struct.unpack_from("<" + kind, content, at)
            at += COUNTS[kind]
            continue
        (size,) = struct.unpack_from("<I", content, at)
        text = content[at + 4 : at + 4 + size]
        found.append(text if kind == "s" else list(struct.iter_unpack({"t": "<QQ", "m": "<HQ"}[kind], text)))
        at += 4 + size
    return *found, content[at:]


def records(data, at, end):
    """Yields (offset, opcode, content, size of the record); the last one ends at `end`."""
    while at < end:
        op, size = struct.unpack_from("<BQ", data, at)
        yield at, op, data[at + 9 : at + 9 + size], 9 + size
        at += 9 + size
    assert at == end, f"a record ends at {at}, not at {end}"


class Judge:
    def __init__(self, data):
        self.data, self.kinds, self.channels, self.records = data, {}, {}, {SCHEMA: b"", CHANNEL: b""}
        self.chunks, self.messages, self.ends = [], [], []  # ends: of the chunks, and messages up to there
        self.sent = collections.Counter()  # of each channel
        assert data.startswith(MAGIC) and data.endswith(MAGIC)
        self.footer = len(data) - 8 - 9 - 20
        start, offsets, crc, _ = fields(data[self.footer + 9 :], "Q", "Q", "I")
        assert data[self.footer] == FOOTER and crc == zlib.crc32(data[start : self.footer + 9 + 16])
        self.data_section(start)
        self.summary(start, offsets)

    def data_section(self, end):
        found = list(records(self.data, 8, end))
        assert found[0][1] == HEADER and found[-1][1] == DATA_END
        self.data_end = found[-1][0]
        for at, op, content, size in found[1:-1]:
            if op in (SCHEMA, CHANNEL):
                self.add(op, content)
                self.records[op] += self.data[at : at + size]
            elif op == CHUNK:
                self.chunk(at, content, size)
            else:
                assert op == INDEX
                channel, entries, _ = fields(content, "H", "t")
                self.chunks[-1]["maps"].append((channel, at))
                self.chunks[-1]["index_size"] += size
                assert entries == self.chunks[-1]["entries"].pop(channel)
        assert not any(chunk["entries"] for chunk in self.chunks)

    def add(self, op, content):
        if op == SCHEMA:
            schema, name, encoding, files, _ = fields(content, "H", "s", "s", "s")
            pool = descriptor_pool.DescriptorPool()
            for file in descriptor_pb2.FileDescriptorSet.FromString(files).file:
                pool.Add(file)
            kind = pool.FindMessageTypeByName(name.decode())
            self.kinds[schema] = message_factory.MessageFactory().GetPrototype(kind)
            assert schema and encoding == b"protobuf"
        else:
            channel, schema, topic, encoding, _, _ = fields(content, "H", "H", "s", "s", "s")
            assert channel not in self.channels and encoding == b"protobuf"
            self.channels[channel] = (topic.decode(), self.kinds[schema])

    def chunk(self, at, content, size):
        first, last, length, crc, compression, rest = fields(content, "Q", "Q", "Q", "I", "s")
        inside, entries, times = rest[8:], {}, []
        assert compression == b"" and struct.unpack_from("<Q", rest) == (length,) and len(inside) == length
        assert crc == zlib.crc32(inside) != 0
        for offset, op, body, _ in records(inside, 0, length):
            channel, sequence, time, published, data = fields(body, "H", "I", "Q", "Q")
            topic, kind = self.channels[channel]
            assert op == MESSAGE and published == time
            assert sequence == self.sent[channel]
            self.sent[channel] += 1
            entries.setdefault(channel, []).append((time, offset))
            self.messages.append((topic, time, kind.FromString(data)))
            times.append(time)
        assert (first, last) == (min(times), max(times))
        self.chunks.append(dict(at=at, size=size, times=(first, last), length=length, entries=entries, maps=[], index_size=0))
        self.ends.append((at + size, len(self.messages)))

    def summary(self, start, offsets):
        groups = {}
        for at, op, content, size in records(self.data, start, offsets):
            begin, bytes_of, contents = groups.get(op, (at, 0, []))
            assert begin + bytes_of == at, "records of one kind follow one another"
            groups[op] = (begin, bytes_of + size, [*contents, content])
        told = [fields(content, "B", "Q", "Q")[:3] for _, op, content, _ in records(self.data, offsets, self.footer)]
        assert told == [(op, *group[:2]) for op, group in groups.items()]
        for op, written in self.records.items():
            begin, size, _ = groups[op]
            assert self.data[begin : begin + size] == written
        for chunk, content in zip(self.chunks, groups[CHUNK_INDEX][2], strict=True):
            told = fields(content, "Q", "Q", "Q", "Q", "m", "Q", "s", "Q", "Q")
            assert told == (*chunk["times"], chunk["at"], chunk["size"], chunk["maps"], chunk["index_size"], b"",
                            chunk["length"], chunk["length"], b"")
        counted = [(channel, self.sent[channel]) for channel in self.channels]
        times = [time for _, time, _ in self.messages]
        (content,) = groups[STATISTICS][2]
        assert fields(content, "Q", "H", "I", "I", "I", "I", "Q", "Q", "m") == (
            len(self.messages), len(self.kinds), len(self.channels), 0, 0, len(self.chunks), min(times), max(times),
            counted, b"")


def bits(numbers):
    return struct.pack(f"<{len(numbers)}d", *numbers)


def listed(value):
    """Returns names and values of all fields, zeros too."""
    return [(field.name, getattr(value, field.name)) for field in value.DESCRIPTOR.fields]


def compare(messages, log):
    """The outputs are the rows of the log, in its order and to the last bit, at its times."""
    outputs = (message for message in messages if not message[0].startswith("/"))
    lines = [line.split(",") for line in pathlib.Path(log).read_text(encoding="utf-8").splitlines()]
    for line in lines[1:]:
        row = [float(cell) for cell in line]
        names, numbers = ["time_s"], row[:1]
        while len(names) < len(lines[0]):
            topic, time, value = next(outputs)
            (_, time_s), *components = listed(value)
            assert time == round(row[0] * 1e9) and bits([time_s]) == bits(row[:1])
            names += [f"{topic}_{name.removeprefix('joint')}" for name, _ in components]
            numbers += [number for _, number in components]
        assert names == lines[0] and bits(numbers) == bits(row)
    assert next(outputs, None) is None
    return len(lines) - 1


def cut(judge, data):
    """Of a file that ends anywhere, the package reads the messages of the whole chunks."""
    chance = random.Random(1)
    expected = [(topic, time, value.SerializeToString()) for topic, time, value in judge.messages]
    with tempfile.NamedTemporaryFile(suffix=".mcap") as file:
        for size in [len(data), *(chance.randrange(8, judge.data_end) for _ in range(30))]:
            pathlib.Path(file.name).write_bytes(data[:size])
            recording = Recording(file.name)
            found = [(topic, time, value.SerializeToString()) for topic, time, value in recording]
            left = max((count for end, count in judge.ends if end <= size), default=0)
            assert found == expected[:left] and recording.whole == (size == len(data)), f"cut at {size} of {len(data)}"


def damaged(judge, data):
    """Bytes that are changed, and a chunk that is taken out, give messages or an Error, and nothing else."""
    chance = random.Random(2)
    ends = [end for end, _ in judge.ends]
    files = [data[: ends[0]] + data[ends[1] :]] if len(ends) > 1 else []
    for place in [*(chance.randrange(8, 3000) for _ in range(40)), *(chance.randrange(8, len(data)) for _ in range(10))]:
        files.append(data[:place] + bytes([data[place] ^ 1 << chance.randrange(8)]) + data[place + 1 :])
    with tempfile.NamedTemporaryFile(suffix=".mcap") as file:
        for number, changed in enumerate(files):
            pathlib.Path(file.name).write_bytes(changed)
            try:
                collections.deque(rows(Recording(file.name)), maxlen=0)
                assert number > 0 or len(ends) < 2, "a chunk is missing, and nobody says so"
            except Error:
                pass


def main():
    data = pathlib.Path(sys.argv[1]).read_bytes()
    judge = Judge(data)
    cut(judge, data)
    damaged(judge, data)
    if len(sys.argv) > 2:
        print(f"{compare(judge.messages, sys.argv[2])} rows, {len(judge.chunks)} chunks")
    for topic, time, event in judge.messages:
        if topic == "/event":
            print(f"{time * 1e-9:.3f} {event.name} {event.status} {event.text}")


if __name__ == "__main__":
    main()
