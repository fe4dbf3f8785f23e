"""Writes chunks and reads them back, one row per point: the input of the replay program."""

import numpy as np

from scenarios import Chunk

NS = 1e9


def columns(axes):
    return ["t_obs_ns", "t_arrival_ns", "chunk_id", "step", "t_target_ns", *axes, "gripper"]


def write(path, chunks, axes):
    """Writes the chunks in the order given; numbers are read back to the last bit."""
    with open(path, "w", encoding="ascii") as file:
        file.write(",".join(columns(axes)) + "\n")
        for chunk in chunks:
            head = f"{round(chunk.t_obs * NS)},{round(chunk.t_arrival * NS)},{chunk.number}"
            for step, (t, q, opening) in enumerate(zip(chunk.t, chunk.q, chunk.gripper)):
                values = ",".join(repr(float(value)) for value in q)
                file.write(f"{head},{step},{round(t * NS)},{values},{opening:g}\n")


def read(path):
    """Returns the chunks of a file, in its order."""
    rows = np.loadtxt(path, delimiter=",", skiprows=1, ndmin=2)
    begins = np.flatnonzero(rows[:, 3] == 0)
    return [
        Chunk(int(part[0, 2]), part[0, 0] / NS, part[0, 1] / NS, part[:, 4] / NS, part[:, 5:-1], part[:, -1])
        for part in np.split(rows, begins[1:])
    ]
