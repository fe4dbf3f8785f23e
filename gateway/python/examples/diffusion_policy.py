#!/usr/bin/python3
"""diffusion_policy.py [ADDRESS]: a stand-in for a diffusion policy, on a simulated FER if there is no address."""

import sys
import time

import numpy as np
import tactus
from simulated import address_of

RATE_HZ, HORIZON, CHUNKS, SPEED_RAD_S, NOISE_RAD = 30, 30, 30, 0.3, np.geomspace(1.0, 2e-4, 10)


def denoise(q, goal, rng):
    """Returns a chunk: noise, from which each level goes on towards what a network would predict, the way to the goal."""
    reach = SPEED_RAD_S * np.arange(HORIZON)[:, None] / RATE_HZ
    predicted = q + np.clip(goal - q, -reach, reach)
    chunk = predicted + rng.normal(0, NOISE_RAD[0], predicted.shape)
    for noise, less in zip(NOISE_RAD, NOISE_RAD[1:]):
        chunk = predicted + less / noise * (chunk - predicted)
        time.sleep(0.01)  # the network; the arm follows the last chunk meanwhile
    return chunk


with address_of(sys.argv[1:], "fer_jrg_pdgc") as address, tactus.Robot(address, rate_hz=RATE_HZ) as robot:
    goal, rng = robot.observe()["q_d"] + 0.2, np.random.default_rng(7)
    for i in range(CHUNKS):
        robot.act(denoise(robot.observe()["q_d"], goal, rng), ends=i == CHUNKS - 1)
    time.sleep(1.2)
    print(f"{1000 * np.abs(robot.observe()['q_d'] - goal).max():.1f} mrad from the goal")
