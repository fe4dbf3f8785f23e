"""Writes tapes: the operations of tests/wcet/tape.hpp, one method each."""

import struct

OPERATIONS = (
    "cycle cycles start state joints velocities efforts wrench point trajectory waypoints append cancel override pause"
    " resume late deaf"
).split()
CODES = {name: code for code, name in enumerate(OPERATIONS)}


def byte(value):
    """A number as i8, at most as large as one."""
    return struct.pack("b", max(-127, min(127, round(value))))


class Tape:
    """A tape under construction; `data` is what there is of it so far."""

    def __init__(self):
        self.data = b""

    def add(self, name, operands=b""):
        self.data += bytes([CODES[name]]) + operands
        return self

    def cycles(self, count):
        while count > 0:
            part = min(count, 256)
            self.add("cycles", bytes([part - 1]))
            count -= part
        return self

    def numbers(self, name, values):
        """joints, velocities, efforts, wrench: i8 each."""
        return self.add(name, b"".join(map(byte, values)))

    def point(self, frames, fields, values):
        """values: six numbers beside the reference and six for every field."""
        return self.add("point", bytes([frames, fields]) + b"".join(map(byte, values)))

    def trajectory(self, frames, fields, interpolation, start, waypoints):
        """waypoints: (time, values) as of point()."""
        head = bytes([frames, fields, interpolation]) + byte(start) + bytes([len(waypoints) - 1])
        return self.add("trajectory", head + b"".join(bytes([t]) + b"".join(map(byte, v)) for t, v in waypoints))

    def waypoints(self, frames, fields, interpolation, start_s, waypoints):
        """waypoints: (time, position, quaternion, velocity, acceleration, wrench, its rate), 32 numbers each."""
        head = bytes([frames, fields, interpolation, len(waypoints)]) + struct.pack("<d", start_s)
        return self.add("waypoints", head + b"".join(struct.pack("<32d", *w) for w in waypoints))


def write_reel(path, tapes):
    """A reel: every tape behind its length."""
    path.write_bytes(b"".join(struct.pack("<I", len(tape)) + tape for tape in tapes))
