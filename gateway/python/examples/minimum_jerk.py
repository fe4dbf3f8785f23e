#!/usr/bin/python3
"""minimum_jerk.py [ADDRESS]: swings every joint out and back along minimum-jerk curves, and prints the tracking error.

Without an address it moves a simulated UR10.
"""

import sys

import numpy as np
import tactus
from simulated import arm_of


def minimum_jerk(begin, end, duration_s, rate_hz=100):
    """Returns t, q, dq, ddq of the rest-to-rest motion with the least jerk (Flash and Hogan 1985)."""
    t = np.linspace(0, duration_s, round(duration_s * rate_hz) + 1)
    s = (t / duration_s)[:, None]
    way = end - begin
    q = begin + way * (10 * s**3 - 15 * s**4 + 6 * s**5)
    dq = way * (30 * s**2 - 60 * s**3 + 30 * s**4) / duration_s
    ddq = way * (60 * s - 180 * s**2 + 120 * s**3) / duration_s**2
    return t, q, dq, ddq


def main():
    with arm_of(sys.argv[1:], "ur10_jrg_pid") as arm:
        here = arm.state().q
        for goal in (here + 0.2, here):
            t, q, dq, ddq = minimum_jerk(arm.state().q, goal, 2.0)
            motion = arm.start(t=t, q=q, dq=dq, ddq=ddq)
            errors = [np.abs(told.desired.q - told.actual.q).max() for told in motion]
            print(f"{motion.result.outcome.name.lower()}: largest error {1000 * max(errors):.1f} mrad")


if __name__ == "__main__":
    try:
        main()
    except (tactus.Error, KeyboardInterrupt) as error:
        sys.exit(f"minimum_jerk: {error or 'interrupted'}")
