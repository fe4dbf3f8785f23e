"""What the client sends and understands, against raw protobuf at the other end."""

import contextlib
import signal
import threading
import time
import unittest

import numpy as np
import stand_in
import tactus
import tactus_pb2 as pb
from stand_in import JOINTS, OFFSET_NS, Peer


@contextlib.contextmanager
def connected(peer=Peer, **settings):
    """Yields an arm and the peer that serves it."""
    with stand_in.stand_in(peer) as (address, peers), tactus.connect(address, **settings) as arm:
        yield arm, peers[0]


def sent(peer, kind):
    return [getattr(message, kind) for message in peer.taken if message.WhichOneof("request") == kind]


class Messages(unittest.TestCase):
    def test_the_hello_is_first_and_names_version_and_client(self):
        with connected(name="me") as (_, peer):
            self.assertEqual(peer.taken[0].hello, pb.Hello(version=pb.VERSION_PRESENT, client="me"))

    def test_numbers_count_up_from_1(self):
        with connected() as (arm, peer):
            arm.point(q=np.zeros(JOINTS))
            numbers = [message.number for message in peer.taken]
        self.assertEqual(numbers, list(range(1, len(numbers) + 1)))

    def test_the_welcome_is_the_robot(self):
        with connected() as (arm, _):
            self.assertEqual((arm.robot.name, arm.robot.dof, arm.robot.period_s), ("ur10", JOINTS, 0.001))
            self.assertEqual(arm.robot.joints[2], tactus.Joint("joint2", -3, 3, 2, 5, 50, 100))
            self.assertEqual((arm.robot.configuration, arm.robot.longest_chunk), (42, 128))

    def test_without_a_motion_no_lease_is_asked_for(self):
        with connected() as (arm, peer):
            arm.state()
            self.assertEqual(sent(peer, "lease"), [])

    def test_the_first_motion_takes_the_lease_and_the_end_gives_it_back(self):
        with connected(priority=7, lease_s=0.5) as (arm, peer):
            arm.point(q=np.zeros(JOINTS))
            self.assertEqual(sent(peer, "lease")[0], pb.Lease(wish=pb.Lease.TAKE, priority=7, timeout_ms=500))
        self.assertEqual(sent(peer, "lease")[-1].wish, pb.Lease.RELEASE)
        self.assertEqual(sent(peer, "cancel"), [])

    def test_an_exception_cancels_and_gives_the_lease_back(self):
        with self.assertRaises(ZeroDivisionError), connected() as (arm, peer):
            arm.point(q=np.zeros(JOINTS))
            raise ZeroDivisionError
        self.assertEqual(len(sent(peer, "cancel")), 1)
        self.assertEqual(sent(peer, "lease")[-1].wish, pb.Lease.RELEASE)

    def test_states_feedback_and_events_are_subscribed_to(self):
        with connected(state_s=0.05, feedback_s=0.1) as (_, peer):
            self.assertEqual(sent(peer, "subscribe"), [pb.Subscribe(state_ms=50, feedback_ms=100, events=True)])

    def test_a_quiet_client_pings(self):
        with connected() as (_, peer):
            end = time.monotonic() + 5
            while len(sent(peer, "ping")) < 3 and time.monotonic() < end:
                time.sleep(0.01)
            self.assertGreaterEqual(len(sent(peer, "ping")), 3)

    def test_stamps_are_converted_both_ways(self):
        with connected() as (arm, peer):
            while arm.clock_uncertainty_ns == float("inf"):
                time.sleep(0.01)
            now = time.monotonic_ns()
            self.assertLess(abs(arm.state().stamp_ns - now), 1_000_000_000)
            with arm.chunks(rate_hz=10) as policy:
                policy.send(np.zeros((3, JOINTS)), observed_ns=now)
            self.assertLess(abs(sent(peer, "chunk")[0].observed_ns - OFFSET_NS - now), 50_000_000)


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
            self.assertEqual([told.time_s for told in feedback], [1.5])
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
        joint = tactus.Refused("joint 1 (a): effort 400 N m exceeds 330 N m (38)", 38, pb.Finding(waypoint=-1, value=400, limit=330))
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


class Streams(unittest.TestCase):
    def test_points_have_the_epoch_and_increasing_sequences(self):
        with connected() as (arm, peer):
            for _ in range(2):
                with arm.stream() as stream:
                    for _ in range(3):
                        stream.send(q=np.zeros(JOINTS), dq=np.ones(JOINTS))
        places = [(point.place.epoch, point.place.sequence) for point in sent(peer, "point")]
        self.assertEqual(places, [(1, i) for i in range(1, 7)])
        self.assertEqual(list(sent(peer, "point")[0].joint.dq), [1] * JOINTS)

    def test_a_point_of_the_tip(self):
        with connected() as (arm, peer):
            arm.point(pose=[0.1, 0.2, 0.3, 1, 0, 0, 0], wrench=[0, 0, -5, 0, 0, 0])
        self.assertEqual(list(sent(peer, "point")[0].task.wrench), [0, 0, -5, 0, 0, 0])

    def test_velocities_have_a_time_out(self):
        with connected() as (arm, peer):
            arm.velocity(twist=[0.1, 0, 0, 0, 0, 0.2], timeout_s=0.05)
        self.assertEqual(list(sent(peer, "velocity")[0].twist), [0.1, 0, 0, 0, 0, 0.2])
        self.assertEqual(sent(peer, "velocity")[0].timeout_ms, 50)

    def test_after_a_stop_a_stream_sends_nothing(self):
        with connected() as (arm, peer), self.assertRaisesRegex(tactus.Stopped, "open a new stream"):
            with arm.stream() as stream:
                stream.send(q=np.zeros(JOINTS))
                arm.stop()
                epoch = arm.state().epoch
                while epoch == 1:
                    epoch = arm.state().epoch
                stream.send(q=np.ones(JOINTS))
        self.assertEqual(len(sent(peer, "point")), 1)

    def test_what_is_refused_is_raised_by_the_next_send_or_the_end(self):
        class Refuses(Peer):
            def take_point(self, message):
                self.report(message.number, pb.Report.REFUSED, status=34, text="joint 1 leaves its range (34)")

        with connected(Refuses) as (arm, _):
            with self.assertRaisesRegex(tactus.Refused, "joint 1 leaves"):
                with arm.stream() as stream:
                    stream.send(q=np.zeros(JOINTS))

    def test_targets_of_a_chunk_follow_the_observation(self):
        with connected() as (arm, peer):
            with arm.chunks(rate_hz=20, relative_to="measured", crossfade_s=0.1) as policy:
                policy.send(np.arange(12.0).reshape(2, 6), observed_ns=time.monotonic_ns(), first=1, ends=True)
        chunk = sent(peer, "chunk")[0]
        self.assertEqual(list(chunk.time_s), [0.05, 0.1])
        self.assertEqual(list(chunk.q), list(range(12)))
        self.assertEqual((chunk.time, chunk.base), (pb.Chunk.ABSOLUTE, pb.Chunk.MEASURED))
        self.assertEqual(chunk.origin_ns, chunk.observed_ns)
        self.assertTrue(chunk.ends)

    def test_late_chunks_are_counted(self):
        class Late(Peer):
            def take_chunk(self, message):
                self.report(message.number, pb.Report.REFUSED, status=59, text="late (59)")

        with connected(Late) as (arm, _), arm.chunks(rate_hz=20) as policy:
            for _ in range(3):
                policy.send(np.zeros((2, JOINTS)), observed_ns=0)
        self.assertEqual(policy.late, 3)

    def test_a_chunk_that_nothing_follows_is_counted(self):
        class Starves(Peer):
            def take_chunk(self, message):
                self.report(message.number, pb.Report.EXECUTED)
                self.report(message.number, pb.Report.STARVED)
                self.report(message.number, pb.Report.STARVED)
                self.state()

        with connected(Starves) as (arm, _):
            with arm.chunks(rate_hz=20) as policy:
                policy.send(np.zeros((2, JOINTS)))
            arm.pause()  # answered behind the reports
            self.assertEqual(arm.starved, 2)

    def test_chunks_longer_than_the_server_takes_are_named(self):
        with connected() as (arm, _), arm.chunks(rate_hz=20) as policy:
            with self.assertRaisesRegex(ValueError, "129 targets; the server takes 128"):
                policy.send(np.zeros((129, JOINTS)))


class Controls(unittest.TestCase):
    def test_each_is_sent_once_and_awaited(self):
        with connected() as (arm, peer):
            arm.override(0.5)
            arm.pause()
            arm.resume()
            arm.cancel()
            arm.rearm()
            arm.stop()
            arm.set_parameters({"pd": {"kp": [1, 2.5], "mode": "fast"}}, check=True)
        kinds = [message.WhichOneof("request") for message in peer.taken]
        kinds = [kind for kind in kinds if kind not in ("hello", "ping", "subscribe", "lease")]
        self.assertEqual(kinds, ["override", "pause", "resume", "cancel", "rearm", "stop", "parameters"])
        self.assertEqual(sent(peer, "override")[0].rate, 0.5)
        values = [(p.section, p.key, p.value) for p in sent(peer, "parameters")[0].set]
        self.assertEqual(values, [("pd", "kp", "1.0 2.5"), ("pd", "mode", "fast")])


if __name__ == "__main__":
    unittest.main()
