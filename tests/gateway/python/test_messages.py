"""What the client sends and understands, against raw protobuf at the other end."""

import time
import unittest

import numpy as np
import tactus
import tactus_pb2 as pb
from connected import connected, sent
from stand_in import JOINTS, OFFSET_NS, Peer


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

    def test_numbers_with_a_meaning_have_names(self):
        with connected() as (arm, peer):
            peer.state(rung=pb.RUNG_STOP, phase=pb.PHASE_BRAKING, status=pb.CODE_HALTED)
            while arm.state().rung == tactus.Rung.NOMINAL:
                pass
            state = arm.state()
        self.assertEqual((state.rung.name, state.phase.name, state.status.name), ("STOP", "BRAKING", "HALTED"))
        self.assertEqual(tactus.Code.NOT_OWNER, 110)

    def test_numbers_of_a_newer_server_stay_numbers(self):
        with connected() as (arm, peer):
            peer.state(rung=77, status=200)
            while arm.state().rung == tactus.Rung.NOMINAL:
                pass
            self.assertEqual((arm.state().rung, arm.state().status), (77, 200))


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

    def test_what_slows_the_arm_down_takes_no_lease(self):
        with connected() as (arm, peer):
            arm.override(0.5)
            arm.pause()
            arm.cancel()
            self.assertEqual(sent(peer, "lease"), [])

    def test_an_override_that_needs_the_lease_takes_it(self):
        class Raises(Peer):
            def take(self, message, kind):
                if kind == "override" and not sent(self, "lease"):
                    self.answer(message, pb.CODE_NOT_OWNER, "nobody owns the motion (110)")
                else:
                    super().take(message, kind)

        with connected(Raises) as (arm, peer):
            arm.override(1.0)
        self.assertEqual(len(sent(peer, "override")), 2)


if __name__ == "__main__":
    unittest.main()
