"""What a program does with an arm, on the simulated robot of this board."""

import contextlib
import pathlib
import tempfile
import time
import unittest

import numpy as np
import served
import tactus
from served import connect
from tactus import Outcome

NOT_OFFERED = 11
GENERATOR = "jrg"  # of the joint pipelines


setUpModule = served.serve_module


class OnRobot(unittest.TestCase):
    def setUp(self):
        """The arm is armed, at rest, as fast as ever, and where it was when the tests began."""
        with connect() as arm:
            if arm.state().rung:
                arm.rearm()
            arm.override(1.0)
            served.go_home(arm)


class Outputs(unittest.TestCase):
    def test_outputs_change_in_time_with_the_arm(self):
        text = served.JOINT_PIPELINE.read_text(encoding="utf-8")
        with tempfile.TemporaryDirectory() as folder:
            pipeline = pathlib.Path(folder) / "outputs.ini"
            pipeline.write_text(text.replace("[robot]", f"[robot]\noutputs = {GENERATOR}.outputs", 1), encoding="utf-8")
            with served.serve(pipeline) as its_address, tactus.connect(its_address, state_s=0.002) as arm:
                self.assertEqual(list(arm.robot.outputs), list(range(8)))
                here = arm.state().q_d
                path = np.linspace(0, 0.1, 31)
                targets = here + np.outer(path, served.moved(arm.robot.dof))
                with arm.chunks(rate_hz=30) as policy:
                    policy.send(targets, first=3, ends=True, outputs={5: np.arange(31) >= 15})
                for state in arm.watch():
                    if state.outputs.get(5):
                        break
                self.assertEqual(state.outputs, {5: True})
                self.assertAlmostEqual(state.q_d[0] - here[0], path[15], delta=0.005)
                arm.stop()
                self.assertEqual(served.at_rest(arm).outputs, {5: True})

    def test_a_pipeline_without_the_wire_has_none(self):
        with connect() as arm:
            self.assertEqual(arm.robot.outputs, {})


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


class Arming(unittest.TestCase):
    def test_drives_that_arm_slowly_are_waited_for(self):
        text = served.JOINT_PIPELINE.read_text(encoding="utf-8")
        plant = "" if "[plant]" in text else "[plant]\n"
        slow = plant + "arming_cycles = 1500"
        with tempfile.TemporaryDirectory() as folder:
            pipeline = pathlib.Path(folder) / "slow.ini"
            text = text.replace("[plant]", f"[plant]\n{slow}", 1) if not plant else f"{text}\n{slow}\n"
            pipeline.write_text(text, encoding="utf-8")
            with served.serve(pipeline) as its_address, tactus.connect(its_address, timeout_s=0.5, state_s=0.02) as arm:
                arm.stop()
                served.at_rest(arm)
                arm.rearm()
                self.assertEqual(arm.state().rung, 0)


@unittest.skipUnless(served.SENSOR_PIPELINE.exists(), "no pipeline of this robot has a sensor")
class Sensor(unittest.TestCase):
    def test_a_tare_returns_the_zero_that_the_simulated_sensor_has(self):
        with served.serve(served.SENSOR_PIPELINE) as address, tactus.connect(address) as arm:
            zero, end = None, time.monotonic() + 20
            while zero is None and time.monotonic() < end:
                try:
                    zero = arm.tare()
                except tactus.Refused as refused:
                    self.assertEqual(refused.status, tactus.Code.MAILBOX_FULL)  # the tare of the start is under way
            np.testing.assert_allclose(zero[:3], [3, -2, 5], atol=0.3)
            np.testing.assert_allclose(zero[3:], [0.1, -0.2, 0.05], atol=0.1)
            self.assertRegex(arm.events()[-1].text, "the zero moved by .* by ")
            arm.stop()
            with self.assertRaisesRegex(tactus.Refused, "Rearm takes a new zero") as stopped:
                arm.tare()
            self.assertEqual(stopped.exception.status, tactus.Code.HALTED)


if __name__ == "__main__":
    unittest.main()
