"""Trajectories as the client sends them, against raw protobuf at the other end."""

import signal
import threading
import unittest

import numpy as np
import tactus
from connected import connected, sent
from stand_in import JOINTS, Peer
from tactus import tactus_pb2 as pb


class Trajectories(unittest.TestCase):
    def test_every_number_arrives_in_its_place(self):
        rng = np.random.default_rng(1)
        q, dq, tau = (rng.normal(size=(100, JOINTS)) for _ in range(3))
        with connected() as (arm, peer):
            arm.move(t=np.arange(100) * 0.1, q=q, dq=dq, tau=tau)
        begin = sent(peer, "begin")[0]
        self.assertTrue(begin.velocities and begin.efforts)
        self.assertFalse(begin.accelerations or begin.poses or begin.check)
        np.testing.assert_array_equal(np.reshape(peer.numbers, (100, 18)), np.hstack([q, dq, tau]))
        np.testing.assert_array_equal(peer.times, np.arange(100) * 0.1)

    def test_poses_are_sent_with_seven_numbers(self):
        pose = np.tile([0.1, 0.2, 0.3, 1, 0, 0, 0], (4, 1))
        with connected() as (arm, peer):
            arm.move(t=np.arange(4), pose=pose)
        self.assertTrue(sent(peer, "begin")[0].poses)
        np.testing.assert_array_equal(np.reshape(peer.numbers, (4, 7)), pose)

    def test_never_more_is_sent_than_there_is_credit_for(self):
        class Mean(Peer):
            window, longest_part = 50, 20
            granted, overdrawn = 0, False

            def take_begin(self, message):
                super().take_begin(message)
                self.granted = self.window

            def take_part(self, message):
                self.waypoints += len(message.part.time_s)
                self.overdrawn |= self.waypoints > self.granted
                if self.waypoints == self.granted:
                    self.report(self.trajectory, pb.Report.STARTED)
                    self.granted += 7
                    self.write(credit=pb.Credit(waypoints=7))

        with connected(Mean) as (arm, peer):
            arm.move(t=np.arange(10), q=np.zeros((10, JOINTS)))  # whose credit is not the next one's
            arm.move(t=np.arange(1000) * 0.001, q=np.zeros((1000, JOINTS)))
        self.assertEqual(sum(len(part.time_s) for part in sent(peer, "part")), 1010)
        self.assertLessEqual(max(len(part.time_s) for part in sent(peer, "part")), 20)
        self.assertFalse(peer.overdrawn)

    def test_feedback_is_yielded_and_the_result_follows(self):
        with connected() as (arm, _):
            motion = arm.start(t=[1.0], q=np.zeros((1, JOINTS)))
            feedback = list(motion)
            self.assertEqual([(told.time_s, told.path_s, told.path_end_s) for told in feedback], [(1.5, 0.5, 2.5)])
            np.testing.assert_array_equal(feedback[0].desired.q, np.ones(JOINTS))
            self.assertIsNone(feedback[0].desired.dq)
            self.assertEqual(motion.result, tactus.Result(tactus.Outcome.SUCCEEDED, 0, "", 3.0, 0.05))

    def test_a_refused_trajectory_says_why(self):
        class Refuses(Peer):
            def take_end(self, message):
                self.report(self.trajectory, pb.Report.REFUSED, status=36, text="waypoint 1, joint 2: too fast (36)")

        with connected(Refuses) as (arm, _):
            with self.assertRaisesRegex(tactus.Refused, "waypoint 1, joint 2: too fast .36.$") as refused:
                arm.move(t=[1.0], q=np.zeros((1, JOINTS)))
            self.assertEqual(refused.exception.status, 36)

    def test_a_refusal_has_its_parts(self):
        text = "waypoint 13 (t = 1.2 s), joint 3 (elbow_joint): position -3.30189 rad is below -3.141593 rad (34); keep off"
        refusal = tactus.Refused(text, 34, pb.Finding(waypoint=13, axis=2, value=-3.30189, limit=-3.141593))
        self.assertEqual(str(refusal), text)
        self.assertEqual(refusal.place, "waypoint 13 (t = 1.2 s), joint 3 (elbow_joint)")
        self.assertEqual((refusal.waypoint, refusal.axis, refusal.remedy), (13, 2, "keep off"))
        self.assertEqual((refusal.value, refusal.limit), (-3.30189, -3.141593))
        joint = tactus.Refused(
            "joint 1 (a): effort 400 N m exceeds 330 N m (38)", 38, pb.Finding(waypoint=-1, value=400, limit=330)
        )
        self.assertEqual((joint.waypoint, joint.axis, joint.value, joint.limit), (None, 0, 400, 330))
        owned = tactus.Refused("another client owns the motion", 110)
        self.assertEqual((owned.waypoint, owned.axis, owned.value, owned.limit), (None, None, None, None))

    def test_an_aborted_trajectory_raises(self):
        class Aborts(Peer):
            def take_end(self, message):
                self.report(self.trajectory, pb.Report.STARTED)
                self.report(self.trajectory, pb.Report.ABORTED, status=49, text="path tolerance")

        with connected(Aborts) as (arm, _), self.assertRaisesRegex(tactus.Aborted, "path tolerance"):
            arm.move(t=[1.0], q=np.zeros((1, JOINTS)))

    def test_a_time_to_wait_that_is_none_is_a_mistake(self):
        class Runs(Peer):
            def take_end(self, message):
                self.report(self.trajectory, pb.Report.STARTED)

        with connected(Runs) as (arm, _):
            motion = arm.start(t=[1.0], q=np.zeros((1, JOINTS)))
            for wrong in (float("nan"), float("inf"), -1, "1", 1j):
                with self.subTest(wrong), self.assertRaisesRegex(ValueError, "^timeout_s"):
                    motion.wait(wrong)
            with self.assertRaises(TimeoutError):
                motion.wait(0)

    def test_ctrl_c_cancels_on_the_path(self):
        signal.signal(signal.SIGINT, signal.default_int_handler)  # a job in the background ignores it

        class Runs(Peer):
            def take_end(self, message):
                self.report(self.trajectory, pb.Report.STARTED)
                threading.Timer(0.05, signal.raise_signal, (signal.SIGINT,)).start()

            def take_cancel(self, message):
                self.report(self.trajectory, pb.Report.CANCELED)
                self.report(message.number, pb.Report.EXECUTED)

        with connected(Runs) as (arm, peer):
            motion = arm.start(t=[1.0], q=np.zeros((1, JOINTS)))
            with self.assertRaises(KeyboardInterrupt):
                motion.wait()
            self.assertEqual(len(sent(peer, "cancel")), 1)
            self.assertEqual(motion.result.outcome, tactus.Outcome.CANCELED)

    def test_joints_that_are_left_out_are_held(self):
        with connected() as (arm, peer):
            arm.move(t=[1.0], q=[[7.0, 8.0]], joints=["joint4", "joint1"])
        self.assertEqual(sent(peer, "begin")[0].terms.held_joints, 0b101101)
        self.assertEqual(peer.numbers, [0, 8, 0, 0, 7, 0])

    def test_arrays_of_a_wrong_shape_are_named(self):
        with connected() as (arm, peer):
            for wrong, trajectory in (
                ("q has the shape .1, 5.; expected .n, 6.", dict(t=[1], q=np.zeros((1, 5)))),
                ("dq has the shape .2, 6.; expected .1, 6.", dict(t=[1], q=np.zeros((1, 6)), dq=np.zeros((2, 6)))),
                ("t has the shape .2,.; give one time for each of the 1 waypoints", dict(t=[1, 2], q=np.zeros((1, 6)))),
                ("either q or pose", dict(t=[1])),
                ("either q or pose", dict(t=[1], q=np.zeros((1, 6)), pose=np.zeros((1, 7)))),
                ("cannot be mixed", dict(t=[1], q=np.zeros((1, 6)), twist=np.zeros((1, 6)))),
                ("joint 'elbow'; the robot has joint0", dict(t=[1], q=np.zeros((1, 1)), joints=["elbow"])),
                (
                    "interpolation 'round'; expected one of by_fields",
                    dict(t=[1], q=np.zeros((1, 6)), interpolation="round"),
                ),
            ):
                with self.subTest(wrong), self.assertRaisesRegex(ValueError, wrong):
                    arm.start(**trajectory)
            self.assertEqual(sent(peer, "begin"), [])


if __name__ == "__main__":
    unittest.main()
