#!/usr/bin/python3
"""wrapped_files.py FOLDER SEED CONTINUOUS UNIT...: writes a random trajectory as a recorder writes it, and unwrapped.

The angles of wrapped.csv are within one turn, here and there by some turns more. unwrapped.csv has what numpy.unwrap makes
of those of the joints whose bits are in CONTINUOUS, from the first row on, which is the reference and may be some turns
from zero. Both have velocities and accelerations.
"""

import pathlib
import sys

import numpy as np

folder, seed, continuous, units = pathlib.Path(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3]), sys.argv[4:]
joints = len(units)
random = np.random.default_rng(seed)
rows = 400
steps = random.uniform(-0.999 * np.pi, 0.999 * np.pi, (rows, joints)) * random.uniform(0, 1, (rows, 1)) ** 2
steps[:, 0] = np.abs(steps[:, 0])  # this one never turns back
way = random.uniform(-7, 7, joints) + np.cumsum(steps, axis=0)
wrapped = (way + np.pi) % (2 * np.pi) - np.pi + 2 * np.pi * random.integers(-3, 4, (rows, joints)) * (
    random.uniform(0, 1, (rows, joints)) < 0.1
)
wrapped[0] = way[0]  # the reference, several turns from zero
rates = random.normal(size=(rows, 2 * joints))
nearest = np.unwrap(wrapped, axis=0)
others = [i for i in range(joints) if not continuous >> i & 1]
nearest[:, others] = wrapped[:, others]
names = [f"{prefix}{i + 1}_{unit}{suffix}" for prefix, suffix in (("q", ""), ("dq", "_s"), ("ddq", "_s2")) for i, unit in enumerate(units)]
times = 0.1 * np.arange(rows)[:, None]
for name, q in {"wrapped": wrapped, "unwrapped": nearest}.items():
    np.savetxt(
        folder / f"{name}.csv",
        np.hstack([times, q, rates]),
        fmt="%.17g",
        delimiter=",",
        header=",".join(["time_s", *names]),
        comments="",
    )
