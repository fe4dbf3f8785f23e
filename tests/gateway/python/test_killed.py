"""A client is killed at random moments of everything it does; the arm comes to rest, free for the next one."""

import contextlib
import os
import random
import signal
import time
import unittest

import numpy as np
import served
import tactus

TRIALS = int(os.environ.get("TACTUS_KILLS", 200 if served.ROBOT == "ur10" else 20))


def trajectory(arm):
    with contextlib.suppress(tactus.Refused):
        arm.move(**served.swing(arm.state().q_d, random.choice((-0.2, 0.2))))


def long_trajectory(arm):
    with contextlib.suppress(tactus.Refused):
        arm.move(**served.swing(arm.state().q_d, random.choice((-0.2, 0.2)), 2.0, 500), window=128)


def points(arm):
    with arm.stream() as stream:
        start = arm.state().q_d
        for step in range(100):
            stream.send(q=start + 0.05 * np.sin(step / 10) * served.moved(arm.robot.dof))
            time.sleep(0.01)


def velocities(arm):
    with arm.stream() as stream:
        for step in range(50):
            stream.velocity(dq=0.1 * np.sin(step / 8) * served.moved(arm.robot.dof), timeout_s=0.3)
            time.sleep(0.02)


def chunks(arm):
    with arm.chunks(rate_hz=30) as policy:
        start = arm.state().q_d
        for step in range(10):
            t = step / 10 + np.arange(20) / 30
            policy.send(
                start + np.outer(0.05 * np.sin(t), served.moved(arm.robot.dof)), observed_ns=time.monotonic_ns()
            )
            time.sleep(0.1)


def controls(arm):
    motion = arm.start(**served.swing(arm.state().q_d, 0.1, 2.0))
    for act in (arm.pause, arm.resume, lambda: arm.override(0.3), lambda: arm.override(1.0), motion.cancel):
        time.sleep(0.02)
        act()


def stop_and_rearm(arm):
    arm.start(**served.swing(arm.state().q_d, 0.1, 2.0))
    time.sleep(0.05)
    arm.stop()
    served.at_rest(arm)
    arm.rearm()


ACTIONS = (trajectory, long_trajectory, points, velocities, chunks, controls, stop_and_rearm)


def live(address, seed, ready):
    """A client that acts until it is killed."""
    random.seed(seed)
    with contextlib.suppress(BaseException), tactus.connect(address, name=f"victim {seed}", lease_s=0.2) as arm:
        os.write(ready, b".")
        while True:
            with contextlib.suppress(tactus.Refused, tactus.Aborted, tactus.Stopped):
                random.choice(ACTIONS)(arm)


class Killed(unittest.TestCase):
    def test_the_arm_is_at_rest_and_free_after_a_kill_at_any_moment(self):
        moments = random.Random(18)
        with served.serve() as address, tactus.connect(address, name="observer") as observer:
            served.home = observer.state().q_d
            for trial in range(TRIALS):
                with self.subTest(trial):
                    self.kill_one(address, trial, moments.uniform(0.0, 0.4))
                    self.look(observer, trial)

    def kill_one(self, address, seed, after_s):
        ready, says = os.pipe()
        child = os.fork()
        if child == 0:
            os.close(ready)
            live(address, seed, says)
            os._exit(1)
        os.close(says)
        served_it = os.read(ready, 1)
        os.close(ready)
        time.sleep(after_s)
        os.kill(child, signal.SIGKILL)
        _, status = os.waitpid(child, 0)
        self.assertEqual(served_it, b".", "the next client is served")
        self.assertTrue(os.WIFSIGNALED(status), "the client lives until it is killed")

    def look(self, observer, trial):
        """At rest, free, and ready for the next one: the observer takes the arm and lays it down where it is."""
        end = time.monotonic() + 5
        while (state := observer.state()).owner:
            self.assertLess(time.monotonic(), end, f"trial {trial}: {state.owner} still owns the arm")
        state = served.at_rest(observer)
        if state.rung:
            observer.rearm()
        observer.resume()
        observer.override(1.0)
        if trial % 10 == 9:  # before the joints have wandered to their limits
            served.go_home(observer)
        observer.release()


if __name__ == "__main__":
    unittest.main()
