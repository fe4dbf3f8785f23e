"""The robots of the benchmark: their limits, where it begins, and replays, by the replay program of a board."""

import dataclasses
import json
import pathlib
import subprocess
import tempfile

import numpy as np

import chunk_files
from signals import SINES, Intent

# The intent takes at most these shares of velocity and acceleration limits.
VELOCITY_SHARE, ACCELERATION_SHARE = 0.85, 0.7
PEAK_V, PEAK_A = (sum(a * (2.0 * np.pi * f) ** k for a, f in SINES) for k in (1, 2))
TIP_M, TIP_RAD = 0.2, 0.25  # of the tip for one rad of the motion of a joint
DISAGREEMENT_M = 0.2  # of the tip for one rad of disagreement; rotations disagree as joints do


class ReplayError(Exception):
    """The replay program failed; what it said."""


@dataclasses.dataclass
class Command:
    """What a replay commanded: one row per cycle, one column per axis."""

    q: np.ndarray
    dq: np.ndarray
    ddq: np.ndarray
    starving: np.ndarray
    counts: dict


def multiply(a, b):
    """Returns the product of quaternions, w first."""
    w = a[0] * b[..., 0] - b[..., 1:] @ a[1:]
    v = a[0] * b[..., 1:] + b[..., :1] * a[1:] + np.cross(a[1:], b[..., 1:])
    return np.concatenate([w[..., None], v], axis=-1)


def exponential(phi):
    """Returns the quaternions of rotation vectors."""
    angle = np.linalg.norm(phi, axis=-1, keepdims=True)
    return np.concatenate([np.cos(angle / 2), 0.5 * np.sinc(angle / (2 * np.pi)) * phi], axis=-1)


class Robot:
    """A board's replay program and what it says of its robot."""

    def __init__(self, program):
        self.program = pathlib.Path(program)
        self.facts = json.loads(self.call("describe"))
        self.name = self.facts["robot"]

    def call(self, *arguments):
        done = subprocess.run([self.program, *map(str, arguments)], capture_output=True, text=True, check=False)
        if done.returncode:
            call = " ".join(map(str, [self.program, *arguments]))
            raise ReplayError(f"{call}: exit code {done.returncode}\n{done.stderr}")
        return done.stdout

    def limits(self, space):
        """Returns the limits of velocity, acceleration and jerk, one row each, and one column per axis of the space."""
        if space == "joint":
            return np.array([self.facts[name] for name in ("dq_max", "ddq_max", "dddq_max")])
        return np.repeat(np.array([self.facts["linear"], self.facts["angular"]]).T, 3, axis=1)

    def scales(self, space):
        """Returns the scale of the intent for every axis: within the limits, and 1 at most."""
        if space == "task":
            v, a, _ = self.limits("task") / np.sqrt(3.0)  # limits are those of the length of a vector
            most = np.repeat([TIP_M, TIP_RAD], 3)
        else:
            v, a, _ = self.limits("joint")
            most = np.ones(len(v))
        return np.minimum.reduce([most, VELOCITY_SHARE * v / PEAK_V, ACCELERATION_SHARE * a / PEAK_A])

    def intent(self, scenario, space):
        return Intent(scenario.motion, scenario.scale * self.scales(space), scenario.switch_s)

    def units(self, space):
        """Returns the disagreement of every axis for one rad."""
        return np.repeat([DISAGREEMENT_M, 1.0], 3) if space == "task" else np.ones(len(self.facts["home"]))

    def home(self, space):
        """Returns where the intent is zero; for the tip the place and no rotation."""
        return np.array(self.facts["home"] if space == "joint" else self.facts["pose"][:3] + [0.0] * 3)

    def positions(self, q, space):
        """Returns the numbers of a chunk file for positions relative to home."""
        if space == "joint":
            return q + self.home(space)
        pose = np.array(self.facts["pose"])
        return np.hstack([pose[:3] + q[:, :3], multiply(pose[3:], exponential(q[:, 3:]))])

    def write_chunks(self, path, chunks, space):
        """Writes the file of chunks that are relative to home."""
        moved = [dataclasses.replace(chunk, q=self.positions(chunk.q, space)) for chunk in chunks]
        joints = [f"q{i + 1}_rad" for i in range(len(self.facts["home"]))]
        chunk_files.write(path, moved, joints if space == "joint" else ["x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"])

    def replay(self, mode, path, space, period_us, duration_s, settings=()):
        """Replays a file of chunks, and returns the command, relative to home."""
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder) / "command"
            said = self.call(mode, path, period_us, duration_s, out, *settings)
            axes = len(self.home(space))
            table = np.fromfile(out).reshape(-1, 3 * axes + 2)
        q, dq, ddq = (table[:, 1 + k * axes : 1 + (k + 1) * axes] for k in range(3))
        return Command(q - self.home(space), dq, ddq, table[:, -1] > 0.5, json.loads(said) if said.strip() else {})
