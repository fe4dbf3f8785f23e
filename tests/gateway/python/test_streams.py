"""Points, velocities and chunks as the client sends them, against raw protobuf at the other end."""

import time
import unittest

import numpy as np
import tactus
from connected import connected, sent
from stand_in import JOINTS, Peer
from tactus import tactus_pb2 as pb


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

    def test_outputs_ride_along_a_chunk(self):
        with connected() as (arm, peer):
            self.assertEqual(arm.robot.outputs, {0: "gripper", 3: "lamp"})
            with arm.chunks(rate_hz=20, outputs_lead_s=0.1) as policy:
                policy.send(np.zeros((3, JOINTS)), outputs={0: [0, 1, 1], 3: np.array([True, False, True])})
                for wrong in ({0: [0, 1]}, {3: [0, 2, 1]}, {0: 1}, {1: [0, 0, 0]}, {-1: [0, 0, 0]}):
                    with self.assertRaisesRegex(ValueError, "output"):
                        policy.send(np.zeros((3, JOINTS)), outputs=wrong)
        (chunk,) = sent(peer, "chunk")
        self.assertEqual(chunk.outputs_lead_s, 0.1)
        self.assertEqual([(c.output, list(c.values)) for c in chunk.channels],
                         [(0, [False, True, True]), (3, [True, False, True])])

    def test_a_point_sets_outputs(self):
        with connected() as (arm, peer):
            arm.point(q=np.zeros(JOINTS), outputs={3: True, 0: False})
            with self.assertRaisesRegex(ValueError, "digital output 2; there is 0, 3"):
                arm.point(q=np.zeros(JOINTS), outputs={2: True})
        (point,) = sent(peer, "point")
        self.assertEqual((point.outputs, point.outputs_mask), (0b1000, 0b1001))

    def test_late_chunks_are_counted_and_a_second_of_them_is_a_warning_with_the_delay(self):
        class Late(Peer):
            def take_chunk(self, message):
                late = pb.Finding(waypoint=-1, axis=-1, value=0.25)
                self.report(message.number, pb.Report.REFUSED, status=59, text="late (59)", finding=late)

        with connected(Late) as (arm, _), self.assertWarnsRegex(UserWarning, "0.250 s after its last target"):
            with arm.chunks(rate_hz=20) as policy:
                policy.send(np.zeros((2, JOINTS)), observed_ns=0)
                policy._collect(0)
                policy._late_since -= 2
                for _ in range(2):
                    policy.send(np.zeros((2, JOINTS)), observed_ns=0)
        self.assertEqual((policy.late, policy.late_s), (3, 0.25))

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


if __name__ == "__main__":
    unittest.main()
