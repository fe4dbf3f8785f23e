"""Writes tapes with the operations of tests/wcet/tape.hpp."""

import struct

OPERATIONS = (
    "cycle cycles start state joints velocities efforts wrench point trajectory waypoints append cancel override pause"
    " resume late deaf"
).split()
CODES = {name: code for code, name in enumerate(OPERATIONS)}


def byte(value):
    """Returns a number as i8, clamped to -127..127."""
    return struct.pack("b", max(-127, min(127, round(value))))


class Tape:
    """A tape under construction; `data` is its present content."""

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
        """Adds joints, velocities, efforts or wrench: one i8 each."""
        return self.add(name, b"".join(map(byte, values)))

    def point(self, frames, fields, values):
        """Adds a point; values: six numbers relative to the reference and six for every field."""
        return self.add("point", bytes([frames, fields]) + b"".join(map(byte, values)))

    def trajectory(self, frames, fields, interpolation, start, waypoints):
        """Adds a trajectory; waypoints: (time, values), values as for point()."""
        head = bytes([frames, fields, interpolation]) + byte(start) + bytes([len(waypoints) - 1])
        return self.add("trajectory", head + b"".join(bytes([t]) + b"".join(map(byte, v)) for t, v in waypoints))

    def waypoints(self, frames, fields, interpolation, start_s, waypoints):
        """Adds waypoints of 32 numbers: (time, position, quaternion, velocity, acceleration, wrench, its rate)."""
        head = bytes([frames, fields, interpolation, len(waypoints)]) + struct.pack("<d", start_s)
        return self.add("waypoints", head + b"".join(struct.pack("<32d", *w) for w in waypoints))


def write_reel(path, tapes):
    """Writes a reel: the length and the data of every tape."""
    path.write_bytes(b"".join(struct.pack("<I", len(tape)) + tape for tape in tapes))
