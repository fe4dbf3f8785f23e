"""What a program does with an arm, on the simulated robot of this board."""

import contextlib
import pathlib
import secrets
import signal
import socket
import subprocess
import tempfile
import time
import unittest

import numpy as np
import served
import tactus
from tactus import Outcome

NOT_OFFERED = 11


def setUpModule():
    global address
    address = unittest.enterModuleContext(served.serve())
    with connect() as arm:
        served.home = arm.state().q_d


def connect(**settings):
    return tactus.connect(address, **settings)


class OnRobot(unittest.TestCase):
    def setUp(self):
        """The arm is armed, at rest, as fast as ever, and where it was when the tests began."""
        with connect() as arm:
            if arm.state().rung:
                arm.rearm()
            arm.override(1.0)
            served.go_home(arm)


class Trajectories(OnRobot):
    def test_a_trajectory_ends_where_it_should(self):
        with connect() as arm:
            path = served.swing(arm.state().q_d)
            self.assertTrue(arm.move(**path).succeeded)
            np.testing.assert_allclose(arm.state().q, path["q"][-1], atol=5e-3)

    def test_feedback_comes_while_it_runs(self):
        with connect() as arm:
            motion = arm.start(**served.swing(arm.state().q_d, -0.2))
            times = [told.time_s for told in motion]
        self.assertGreater(len(times), 5)
        self.assertEqual(times, sorted(times))
        self.assertTrue(motion.result.succeeded)

    def test_one_that_is_longer_than_its_window_runs_through(self):
        with connect() as arm:
            path = served.swing(arm.state().q_d, 0.2, 2.0, 500)
            motion = arm.start(**path, window=128)
            self.assertTrue(motion.wait().succeeded)
            np.testing.assert_allclose(arm.state().q_d, path["q"][-1], atol=1e-9)

    def test_a_refusal_names_the_limit_and_moves_nothing(self):
        with connect() as arm:
            before = served.at_rest(arm).q_d
            path = served.swing(before, 100.0)
            with self.assertRaisesRegex(tactus.Refused, "waypoint [0-9]+, joint [0-9]+ .*position") as refused:
                arm.move(**path)
            self.assertEqual(refused.exception.status, 34)
            self.assertRegex(refused.exception.place, "^waypoint [0-9]+.*, joint [0-9]+ ")
            joint = [joint for joint in arm.robot.joints if f"({joint.name})" in refused.exception.place][0]
            self.assertAlmostEqual(refused.exception.limit, joint.max_rad, 5)
            self.assertGreater(refused.exception.value, joint.max_rad)
            self.assertTrue(refused.exception.remedy)
            np.testing.assert_array_equal(arm.state().q_d, before)

    def test_check_moves_nothing(self):
        with connect() as arm:
            before = served.at_rest(arm).q_d
            try:
                arm.check(**served.swing(before))
            except tactus.Refused as refusal:
                if refusal.status == NOT_OFFERED:
                    self.skipTest("this server does not offer to check")
                raise
            with self.assertRaises(tactus.Refused):
                arm.check(**served.swing(before, 100.0))
            np.testing.assert_array_equal(arm.state().q_d, before)
            self.assertEqual(arm.state().owner, "")

    def test_a_cancel_brakes_on_the_path(self):
        with connect() as arm:
            path = served.swing(arm.state().q_d, 0.3, 2.0)
            motion = arm.start(**path)
            time.sleep(0.8)
            self.assertEqual(motion.cancel().outcome, Outcome.CANCELED)
            q = served.at_rest(arm).q_d
            way = q - path["q"][0]
            np.testing.assert_allclose(way, way[0] * served.moved(arm.robot.dof), atol=1e-6)  # on this path
            self.assertLess(way[0], 0.29)
            with self.assertRaises(tactus.Refused):
                arm.cancel()

    def test_a_newer_trajectory_preempts(self):
        with connect() as arm:
            first = arm.start(**served.swing(arm.state().q_d, 0.3, 2.0))
            time.sleep(0.2)
            second = arm.start(t=[2.0], q=arm.state().q_d[None])
            self.assertEqual(first.wait().outcome, Outcome.PREEMPTED)
            self.assertTrue(second.wait().succeeded)

    def test_pause_resume_and_override(self):
        with connect() as arm:
            motion = arm.start(**served.swing(arm.state().q_d, -0.2))
            time.sleep(0.3)
            arm.pause()
            paused = served.at_rest(arm).q_d
            arm.override(0.5)
            arm.resume()
            self.assertTrue(motion.wait().succeeded)
            self.assertGreater(np.abs(arm.state().q_d - paused).max(), 0.01)
            self.assertEqual(arm.state().override, 0.5)
            arm.override(1.0)


class Streams(OnRobot):
    def test_points_are_followed(self):
        with connect() as arm:
            start = served.at_rest(arm).q_d
            with arm.stream() as stream:
                for step in range(1, 31):
                    stream.send(q=start + 0.002 * step * served.moved(arm.robot.dof))
                    time.sleep(0.02)
            np.testing.assert_allclose(served.at_rest(arm).q_d, start + 0.06 * served.moved(arm.robot.dof), atol=1e-6)

    def test_a_velocity_ends_with_its_time_out(self):
        with connect() as arm:
            start = served.at_rest(arm).q_d
            way = np.zeros(arm.robot.dof)
            way[0] = -0.2
            arm.velocity(dq=way, timeout_s=0.3)
            moved = served.at_rest(arm).q_d - start
            self.assertTrue(-0.15 < moved[0] < -0.02, moved)
            np.testing.assert_allclose(moved[1:], 0, atol=1e-9)

    def test_chunks_are_spliced(self):
        with connect() as arm:
            start, rate_hz = served.at_rest(arm).q_d, 30
            zero_ns = time.monotonic_ns()
            with arm.chunks(rate_hz=rate_hz) as policy:
                for step in range(6):
                    observed_ns = time.monotonic_ns()
                    t = (observed_ns - zero_ns) / 1e9 + np.arange(20) / rate_hz
                    time.sleep(0.1)
                    targets = start + np.outer(0.05 * np.minimum(t, 1.2), served.moved(arm.robot.dof))
                    policy.send(targets, observed_ns=observed_ns, ends=step == 5)
                    time.sleep(0.1)
            end = served.at_rest(arm)
            np.testing.assert_allclose(end.q_d, start + 0.06 * served.moved(arm.robot.dof), atol=5e-3)
            self.assertEqual(policy.late, 0)
            self.assertGreater(end.targets_trimmed, 0)


class Owners(OnRobot):
    def test_another_one_is_refused_until_the_arm_is_free(self):
        with connect(name="first") as first, connect(name="second") as second:
            here = first.state().q_d
            first.point(q=here)
            with self.assertRaisesRegex(tactus.Refused, "first"):
                second.point(q=here)
            first.release()
            second.point(q=here)

    def test_a_higher_priority_takes_the_arm(self):
        with connect(name="low") as low, connect(name="high", priority=9) as high:
            motion = low.start(**served.swing(low.state().q_d, 0.2, 3.0))
            time.sleep(0.2)
            with contextlib.suppress(tactus.Refused):
                high.velocity(dq=np.zeros(high.robot.dof))
            with contextlib.suppress(tactus.Aborted):
                self.assertFalse(motion.wait(5).succeeded)
            with self.assertRaises(tactus.Refused):
                low.start(**served.swing(low.state().q_d))

    def test_after_a_stop_only_rearm_moves_the_arm(self):
        with connect() as arm:
            motion = arm.start(**served.swing(arm.state().q_d, 0.2, 3.0))
            time.sleep(0.3)
            with connect() as somebody:
                somebody.stop()
            with self.assertRaises(tactus.Error):
                motion.wait(5)
            served.at_rest(arm)
            with self.assertRaises(tactus.Refused):
                arm.point(q=arm.state().q)
            arm.rearm()
            arm.point(q=arm.state().q_d)

    def test_the_stream_of_a_stopped_arm_raises(self):
        with connect() as arm:
            with self.assertRaises(tactus.Stopped), arm.stream() as stream:
                while True:
                    stream.send(q=arm.state().q_d)
                    with connect() as somebody:
                        somebody.stop()
            arm.rearm()


class Keys(unittest.TestCase):
    """A server at an address of the network, which asks for a key."""

    @classmethod
    def setUpClass(cls):
        folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.key, cls.other = folder / "arm.key", folder / "other.key"
        for file in (cls.key, cls.other):
            file.touch(mode=0o600)
            file.write_text(secrets.token_hex(32) + "\n", encoding="ascii")
        with socket.create_server(("127.0.0.1", 0)) as free:
            cls.address = f"tcp:127.0.0.1:{free.getsockname()[1]}"
        log = cls.enterClassContext(tempfile.TemporaryFile("w+"))
        command = [
            served.PROGRAM,
            "serve",
            served.JOINT_PIPELINE,
            "--virtual-time",
            "--listen",
            cls.address,
            "--key",
            cls.key,
        ]
        server = cls.enterClassContext(subprocess.Popen(command, stdout=log, stderr=log))
        cls.addClassCleanup(server.terminate)
        tactus._await_server(server, cls.address, log, cls.key)

    def test_with_the_key_the_arm_moves(self):
        with tactus.connect(self.address, key=self.key) as arm:
            path = served.swing(arm.state().q_d, 0.1, 1.0, 2000)  # parts longer than a record
            self.assertTrue(arm.move(**path).succeeded)

    def test_with_another_key_or_none_nobody_is_let_in(self):
        for key in (self.other, None):
            with self.subTest(key), self.assertRaisesRegex(tactus.Lost, "have the same key, or none"):
                tactus.connect(self.address, key=key)

    def test_a_server_without_a_key_is_named(self):
        with self.assertRaisesRegex(tactus.Lost, "does the server have a key|same key"):
            tactus.connect(address, key=self.key, timeout_s=1)

    def test_a_key_that_others_may_read_is_refused(self):
        self.other.chmod(0o644)
        with self.assertRaisesRegex(ValueError, "other.key: others may read it.*chmod 600"):
            tactus.connect(self.address, key=self.other)
        self.other.chmod(0o600)
        self.other.write_text("secret", encoding="ascii")
        with self.assertRaisesRegex(ValueError, "64 hexadecimal digits") as refused:
            tactus.connect(self.address, key=self.other)
        self.assertNotIn("secret", str(refused.exception))
        self.other.write_text(secrets.token_hex(32), encoding="ascii")


class VirtualTime(unittest.TestCase):
    def rung_after_a_pause(self, *options):
        """Returns the rung of a server that was not run for 0.2 s."""
        with tempfile.TemporaryFile() as log, tempfile.TemporaryDirectory() as folder:
            command = [served.PROGRAM, "serve", served.JOINT_PIPELINE, "--listen", f"unix:{folder}/s", *options]
            with subprocess.Popen(command, stdout=log, stderr=log) as server:
                try:
                    tactus._await_server(server, f"unix:{folder}/s", log)
                    with tactus.connect(f"unix:{folder}/s") as arm:
                        server.send_signal(signal.SIGSTOP)
                        time.sleep(0.2)
                        server.send_signal(signal.SIGCONT)
                        time.sleep(0.2)
                        return arm.state().rung
                finally:
                    server.terminate()

    def test_a_late_cycle_delays_the_robot_and_does_not_brake_it(self):
        self.assertEqual(self.rung_after_a_pause("--virtual-time"), 0)

    def test_in_real_time_it_brakes(self):
        self.assertGreater(self.rung_after_a_pause(), 1)


class Parameters(OnRobot):
    @staticmethod
    def gain(arm, key="kp"):
        (found,) = (p for p in arm.parameters() if p.section in ("pd", "pid") and p.key == key)
        return found

    def test_present_values_are_listed_with_what_may_change(self):
        with connect() as arm:
            listed = arm.parameters()
        places = [(p.section, p.key) for p in listed]
        self.assertEqual(len(places), len(set(places)))
        fixed = {(p.section, p.key) for p in listed if not p.tunable}
        self.assertIn(("guard", "max_velocity"), fixed)
        self.assertNotIn("", [p.value for p in listed if p.tunable])

    def test_a_set_is_in_force_when_the_call_returns_and_goes_back(self):
        with connect() as arm, connect() as other:
            kp = self.gain(arm)
            half = 0.5 * kp.numbers
            arm.set_parameters({kp.section: {"kp": half}})
            now = self.gain(other)
            np.testing.assert_array_equal(now.numbers, half)
            self.assertEqual(now.file_value, kp.value)
            self.assertIn(f"[{kp.section}] kp: {kp.value} -> {now.value}", other.events()[-1].text)
            arm.set_parameters({kp.section: {"kp": kp.value}})
            self.assertEqual(self.gain(other).value, kp.value)

    def test_a_check_changes_nothing_and_needs_no_lease(self):
        with connect(priority=200) as owner, connect() as arm:
            owner.override(1.0)
            kp = self.gain(arm)
            arm.set_parameters({kp.section: {"kp": 1.0}}, check=True)
            with self.assertRaisesRegex(tactus.Refused, "kp: .*-1.0 .*it must be >"):
                arm.set_parameters({kp.section: {"kp": -1.0}}, check=True)
            with self.assertRaises(tactus.Refused):
                arm.set_parameters({kp.section: {"kp": 1.0}})
            self.assertEqual(self.gain(arm).value, kp.value)

    def test_what_is_refused_changes_nothing(self):
        with connect() as arm:
            kp = self.gain(arm)
            for bad in (
                {kp.section: {"kp": 1.0, "kd": "nan"}},
                {kp.section: {"kp": 1.0, "kx": 1.0}},
                {kp.section: {"kp": 1.0}, "guard": {"max_velocity": 0.1}},
                {kp.section: {"kp": 1.0}, "nowhere": {"kp": 1.0}},
                {kp.section: {"kp": "1.0\n[guard]"}},
                {},
            ):
                with self.assertRaises(tactus.Refused):
                    arm.set_parameters(bad)
            self.assertEqual(self.gain(arm).value, kp.value)

    def test_gains_change_while_the_arm_moves(self):
        with connect() as arm:
            kp = self.gain(arm)
            motion = arm.start(**served.swing(arm.state().q_d, 0.2, 2.0))
            for factor in (0.7, 1.4, 1.0):
                time.sleep(0.3)
                arm.set_parameters({kp.section: {"kp": factor * kp.numbers}})
            self.assertTrue(motion.wait().succeeded)
            self.assertEqual(arm.state().rung, 0)


if __name__ == "__main__":
    unittest.main()
