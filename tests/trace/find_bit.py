#!/usr/bin/python3
"""find_bit PROGRAM FOLDER CYCLE [FILL]: lets the comparison of traces find one bit.

PROGRAM plays a tape in which joint 3 is measured in CYCLE, and again with the last bit of that measurement changed,
or, with FILL, the same tape over other bytes in the player's memory. Prints the table, and ends with 0 if all is equal.
"""

import pathlib
import struct
import sys

sys.path[:0] = ["scripts/trace", "scripts/wcet"]

import comparison  # noqa: E402
import runs  # noqa: E402
from tape import Tape, write_reel  # noqa: E402

DOF, CYCLES = 7, 700
READY = (0, -0.785398, 0, -2.356194, 0, 1.570796, 0.785398)


def tape_with(cycle, bit):
    """Returns a tape at rest whose client sends a trajectory; its bit is in the measurement of a cycle."""
    def state(q3):
        q = list(READY)
        q[2] = q3
        return struct.pack(f"<{3 * DOF + 6}f", *q, *[0.0] * (2 * DOF + 6))

    tape = Tape().add("state", state(0.001)).add("start")
    waypoint = struct.pack(f"<{1 + 4 * DOF}d", 0.5, *READY, *[0.0] * (3 * DOF))
    tape.add("waypoints", bytes([0, 0, 0, 1]) + struct.pack("<d", float("-inf")) + waypoint)
    bits, = struct.unpack("<I", struct.pack("<f", 0.001))
    changed, = struct.unpack("<f", struct.pack("<I", bits ^ bit))
    for k in range(CYCLES):
        tape.add("state", state(changed if k == cycle else 0.001)).add("cycle")
    return tape.data


class Player:
    """A machine that plays a job with another tape."""

    def __init__(self, name, program, folder, data, fill):
        self.name, self.program, self.folder, self.data, self.fill = name, program, pathlib.Path(folder), data, fill

    def command(self, _, job):
        """Puts the tape into the job, over `fill` more in the player's memory."""
        head, rest = bytearray(job.read_bytes()[:13]), job.read_bytes()[13:]
        size, = struct.unpack_from("<I", rest)
        head[12] ^= self.fill
        mine, reel = self.folder / f"{self.name}.job", self.folder / "reel"
        write_reel(reel, [rest[4 : 4 + size], self.data])
        mine.write_bytes(head + reel.read_bytes())
        return [self.program, str(mine)]


def main():
    program, folder, cycle, *fill = sys.argv[1:]
    runs.BUILD = pathlib.Path(folder)
    run = runs.Run("fer_jrg_pdgc", "", "fer")
    run.folder.mkdir(exist_ok=True)
    (run.folder / "pipeline.ini").write_text(runs.text_of(run.pipeline), encoding="utf-8")
    (run.folder / "run.tape").write_bytes(b"")
    other = Player("other", program, folder, tape_with(int(cycle), 0 if fill else 1), int(fill[0]) if fill else 0)
    machines = [Player("first", program, folder, tape_with(int(cycle), 0), 0), other]
    comparison.os.sched_getaffinity = lambda _: [0]  # one at a time: a machine has one job
    return 0 if comparison.compare([run], machines, {"first": 0, "other": 0}, False, True) else 1


if __name__ == "__main__":
    sys.exit(main())
