#!/usr/bin/python3
"""chunked_policy.py [ADDRESS]: a stand-in for a learned policy. It replays a demonstration in noisy chunks, too late.

Every 300 ms it looks at the arm, thinks for 150 ms, and sends 30 targets at 30 Hz for the time from its observation on.
Two chunks never agree: each is off by an offset of 5 mrad and noise of 1 mrad. The server splices them smoothly.
Without an address it moves a simulated UR10.
"""

import sys
import time

import numpy as np
import tactus
from simulated import arm_of

RATE_HZ, HORIZON, LATENCY_S, INTERVAL_S, DURATION_S = 30, 30, 0.15, 0.3, 6.0


def demonstration(t):
    """Returns [len(t), 1] rad: from rest to rest in DURATION_S."""
    t = np.clip(t, 0, DURATION_S)
    return (0.3 * np.sin(np.pi * t / DURATION_S) ** 2 * np.sin(3 * np.pi * t / DURATION_S))[:, None]


def main():
    rng = np.random.default_rng(18)
    with arm_of(sys.argv[1:], "ur10_jrg_pid") as arm, arm.chunks(rate_hz=RATE_HZ) as policy:
        here, start_ns, errors = arm.state().q_d, time.monotonic_ns(), []
        for step in range(round(DURATION_S / INTERVAL_S) + 1):
            observation = arm.state()
            t = (observation.stamp_ns - start_ns) / 1e9 + np.arange(HORIZON) / RATE_HZ
            targets = here + demonstration(t) + rng.normal(0, 0.005, arm.robot.dof) + rng.normal(0, 0.001, (HORIZON, 1))
            time.sleep(LATENCY_S)  # inference
            policy.send(targets, observed_ns=observation.stamp_ns, ends=t[0] > DURATION_S)
            wake_ns = start_ns + round((step + 1) * INTERVAL_S * 1e9)
            time.sleep(max(0.0, (wake_ns - time.monotonic_ns()) / 1e9))
            now = arm.state()
            errors.append(now.q - here - demonstration(np.array([(now.stamp_ns - start_ns) / 1e9])))
        told = arm.state()
    print(
        f"{told.chunks_taken} chunks taken, {told.chunks_late} late, {told.targets_trimmed} targets trimmed;"
        f" off the demonstration by {1000 * np.sqrt(np.mean(np.square(errors))):.0f} mrad rms"
    )


if __name__ == "__main__":
    try:
        main()
    except (tactus.Error, KeyboardInterrupt) as error:
        sys.exit(f"chunked_policy: {error or 'interrupted'}")
