#!/usr/bin/python3
"""jog.py [ADDRESS]: moves the joints by keys: 1 to 7 choose one, + and - move it while they are held, q ends.

Without an address it moves a simulated UR10. Keys may come through a pipe: `echo 1++++2---q | jog.py`.
"""

import contextlib
import os
import select
import sys
import termios
import tty

import numpy as np
import tactus
from simulated import arm_of

SPEED_RAD_S, TIMEOUT_S, REPEAT_S = 0.3, 0.3, 0.05


@contextlib.contextmanager
def keyboard():
    """Yields a function that returns the next key, "" if none is pressed; keys come without Enter from a terminal."""
    fd = sys.stdin.fileno()
    before = termios.tcgetattr(fd) if os.isatty(fd) else None
    if before:
        tty.setcbreak(fd)
    try:
        yield lambda: (os.read(fd, 1).decode(errors="replace") or "q") if select.select([fd], [], [], REPEAT_S)[
            0
        ] else ""
    finally:
        if before:
            termios.tcsetattr(fd, termios.TCSADRAIN, before)


def main():
    with arm_of(sys.argv[1:], "ur10_jrg_pid") as arm, arm.stream() as stream, keyboard() as key:
        joint = 0
        while (pressed := key()) != "q":
            if pressed.isdigit() and 1 <= int(pressed) <= arm.robot.dof:
                joint = int(pressed) - 1
            elif pressed in ("+", "-"):
                dq = np.zeros(arm.robot.dof)
                dq[joint] = SPEED_RAD_S if pressed == "+" else -SPEED_RAD_S
                stream.velocity(dq=dq, timeout_s=TIMEOUT_S)
            print("\r" + " ".join(f"{angle:8.4f}" for angle in arm.state().q), end="", flush=True)
    print()


if __name__ == "__main__":
    try:
        main()
    except (tactus.Error, KeyboardInterrupt) as error:
        sys.exit(f"jog: {error or 'interrupted'}")
