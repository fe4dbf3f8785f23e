"""The class Robot: what it sends, against raw protobuf, and what it does with the simulated robot of this board."""

import subprocess
import sys
import time
import unittest

import numpy as np
import served
import stand_in
import tactus
from connected import sent
from stand_in import JOINTS, OFFSET_NS

setUpModule = served.serve_module


class Sent(unittest.TestCase):
    """Against the stand-in, which has joints and no reference."""

    def setUp(self):
        self.address, self.peers = self.enterContext(stand_in.stand_in())

    def test_a_chunk_counts_from_the_observation_however_late_it_is_sent(self):
        with tactus.Robot(self.address, rate_hz=20, relative_to="measured", name="policy") as robot:
            seen = robot.observe()
            time.sleep(0.1)
            robot.act(np.ones((2, JOINTS)), first=1, ends=True)
        (chunk,) = sent(self.peers[0], "chunk")
        self.assertEqual((list(chunk.time_s), chunk.ends, len(chunk.q)), ([0.05, 0.1], True, 2 * JOINTS))
        self.assertAlmostEqual(chunk.observed_ns - OFFSET_NS, int(seen["stamp_ns"]), delta=10_000_000)
        self.assertEqual(chunk.base, tactus.tactus_pb2.Chunk.MEASURED)
        self.assertEqual(self.peers[0].taken[0].hello.client, "policy")

    def test_an_observation_has_what_there_is_as_arrays(self):
        with tactus.Robot(self.address) as robot:
            seen = robot.observe()
        self.assertEqual(set(seen), {"q", "dq", "tau", "margin_s", "stamp_ns"})
        self.assertTrue(all(isinstance(value, np.ndarray) for value in seen.values()))
        self.assertEqual((seen["q"].tolist(), seen["stamp_ns"].dtype), ([0.5] * JOINTS, np.int64))
        self.assertFalse(sent(self.peers[0], "lease"))

    def test_one_target_is_a_point_and_a_mistake_is_sent_by_no_kind(self):
        with tactus.Robot(self.address) as robot:
            robot.act(np.arange(float(JOINTS)))
            for wrong in (np.ones(JOINTS + 1), np.ones((2, 3, JOINTS)), "left"):
                with self.assertRaises(ValueError):
                    robot.act(wrong)
        self.assertEqual(list(sent(self.peers[0], "point")[0].joint.q), list(range(JOINTS)))
        self.assertEqual(len(sent(self.peers[0], "point")) + len(sent(self.peers[0], "chunk")), 1)

    def test_without_a_connection_and_with_a_second_one_it_says_so(self):
        robot = tactus.Robot(self.address)
        robot.disconnect()
        with self.assertRaisesRegex(RuntimeError, "call connect"):
            robot.observe()
        with robot, self.assertRaisesRegex(RuntimeError, "disconnect\\(\\) first"):
            robot.connect()
        self.assertEqual(len(self.peers), 1)

    def test_an_exception_cancels_and_disconnect_does_not(self):
        with self.assertRaises(KeyboardInterrupt), tactus.Robot(self.address) as robot:
            robot.act(np.ones((2, JOINTS)))
            raise KeyboardInterrupt
        robot.connect()
        robot.act(np.ones((2, JOINTS)))
        robot.disconnect()
        self.assertEqual([len(sent(peer, "cancel")) for peer in self.peers], [1, 0])


class OnRobot(unittest.TestCase):
    def test_chunks_then_a_target_and_again_after_a_stop(self):
        with tactus.Robot(served.address, rate_hz=50) as robot:
            way = 0.02 * served.moved(robot.arm.robot.dof)
            goal = robot.observe()["q_d"] + way
            robot.act(np.tile(goal, (30, 1)), ends=True)
            self.assertLess(np.abs(served.at_rest(robot.arm).q_d - goal).max(), 1e-6)
            robot.act(goal - way)
            self.assertLess(np.abs(served.at_rest(robot.arm).q_d - goal + way).max(), 1e-6)
            robot.arm.stop()
            with self.assertRaises(tactus.Stopped):
                while True:
                    robot.act(goal)
            served.at_rest(robot.arm)
            robot.arm.rearm()
            robot.act(goal)
            self.assertLess(np.abs(served.at_rest(robot.arm).q_d - goal).max(), 1e-6)


class Example(unittest.TestCase):
    def test_thirty_lines_denoise_chunks_and_move_a_simulated_fer_to_the_goal(self):
        example = served.ROOT / "gateway/python/examples/diffusion_policy.py"
        self.assertLessEqual(len(example.read_text(encoding="utf-8").splitlines()), 30)
        said = subprocess.run([sys.executable, example], capture_output=True, text=True, timeout=120, check=True).stdout
        self.assertLess(float(said.split()[0]), 10)


if __name__ == "__main__":
    unittest.main()
