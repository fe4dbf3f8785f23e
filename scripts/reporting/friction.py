"""The joint friction of the simulated robot, read from its model: sim_plant/arm/<robot>_mjcf.cpp."""

import pathlib
import re

import numpy as np

from reporting.inputs import read_text

MODELS = pathlib.Path(__file__).resolve().parents[2] / "sim_plant/arm"
JOINT = re.compile(r'<joint name="joint\d+"[^/]*? user="(\S+) (\S+) (\S+)"')


def torque(robot, velocity):
    """Returns the friction at joint velocities [rows, joints], N m; zero for a model without friction.

    a / (1 + exp(-b (dq + c))) - a / (1 + exp(-b c)): sim_plant/arm/arm.hpp.
    """
    found = JOINT.findall(read_text(MODELS / f"{robot}_mjcf.cpp"))
    if len(found) != velocity.shape[1]:
        return np.zeros_like(velocity)
    a, b, c = np.array(found, float).T
    return a / (1 + np.exp(-b * (velocity + c))) - a / (1 + np.exp(-b * c))
