"""What the client sends and understands, against raw protobuf at the other end."""

import contextlib
import threading
import time
import unittest
from unittest import mock

import numpy as np
import stand_in
import tactus
from connected import connected, sent
from stand_in import JOINTS, OFFSET_NS, ZERO, Peer
from tactus import tactus_pb2 as pb

NAN, INF, COMPLEX = float("nan"), float("inf"), 1 + 0.01j
HERE, ONE = np.zeros(JOINTS), dict(t=[1.0], q=np.zeros((1, JOINTS)))


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
            np.testing.assert_array_equal(arm.tare(), ZERO)
        kinds = [message.WhichOneof("request") for message in peer.taken]
        kinds = [kind for kind in kinds if kind not in ("hello", "ping", "subscribe", "lease")]
        self.assertEqual(kinds, ["override", "pause", "resume", "cancel", "rearm", "stop", "parameters", "tare"])
        self.assertEqual(sent(peer, "override")[0].rate, 0.5)
        values = [(p.section, p.key, p.value) for p in sent(peer, "parameters")[0].set]
        self.assertEqual(values, [("pd", "kp", "1.0 2.5"), ("pd", "mode", "fast")])

    def test_a_tare_may_take_longer_than_an_answer(self):
        class Slow(Peer):
            def take_tare(self, message):
                for _ in range(10):
                    time.sleep(0.1)
                    self.state()
                super().take_tare(message)

        with connected(Slow, timeout_s=0.3) as (arm, peer):
            np.testing.assert_array_equal(arm.tare(), ZERO)
            self.assertEqual(len(sent(peer, "tare")), 1)
            self.assertNotEqual(sent(peer, "lease"), [])

    def test_a_tare_that_is_refused_raises_the_figures(self):
        class Contact(Peer):
            def take_tare(self, message):
                finding = pb.Finding(waypoint=-1, axis=0, value=12.0, limit=10.0)
                self.report(message.number, pb.Report.REFUSED, status=pb.CODE_TARE_LIMIT, text="far", finding=finding)

        with connected(Contact) as (arm, _), self.assertRaisesRegex(tactus.Refused, "far") as caught:
            arm.tare()
        refused = caught.exception
        self.assertEqual((refused.status, refused.value, refused.limit), (tactus.Code.TARE_LIMIT, 12.0, 10.0))

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


def each(name, call, *values):
    """Calls of an arm with each of some values for an argument, behind the name that the error has."""
    return [(name, value, lambda arm, value=value: call(arm, value)) for value in values]


def parameters(values):
    return lambda arm: arm.set_parameters(values)


BAD_CALLS = [
    *each("joints", lambda arm, joints: arm.start(t=[1], q=[[0.1, 0.2]], joints=joints), ["joint1", "joint1"]),
    *each("joints", lambda arm, joints: arm.start(t=[1], q=np.zeros((1, 0)), joints=joints), []),
    *each("joints", lambda arm, joints: arm.stream(joints=joints), [], ["joint1", "joint1"]),
    *each("q", lambda arm, q: arm.point(q=q), HERE + COMPLEX, [None] * JOINTS, ["1"] * JOINTS, [[1], [1, 2]], HERE[1:]),
    *each("t", lambda arm, t: arm.start(t=t, q=[HERE]), [COMPLEX], ["1"], [[1], [1, 2]], [], None),
    *each("dq", lambda arm, dq: arm.velocity(dq=dq), HERE + COMPLEX, HERE[1:]),
    *each("timeout_s", lambda arm, s: arm.velocity(dq=HERE, timeout_s=s), NAN, INF, -1, 0, 11, None, "1", COMPLEX, [1]),
    *each("rate", lambda arm, rate: arm.override(rate), NAN, INF, -0.1, 1.1, None, "1", COMPLEX, [1, 1]),
    *each("within_s", lambda arm, s: arm.rearm(s), NAN, INF, -1, None),
    *each("motion_frame", lambda arm, at: arm.start(**ONE, motion_frame=at), "x" * 64, "\u20ac" * 22, "\ud800", None),
    *each("wrench_frame", lambda arm, frame: arm.start(**ONE, wrench_frame=frame), "x" * 64),
    *each("motion_frame", lambda arm, frame: arm.stream(motion_frame=frame), "x" * 64),
    *each("motion_frame", lambda arm, frame: arm.chunks(rate_hz=20, motion_frame=frame), "x" * 64),
    *each("window", lambda arm, window: arm.start(**ONE, window=window), -1, 1.5, 2**32, 2**64, NAN, INF, None),
    *each("start_ns", lambda arm, ns: arm.start(**ONE, start_ns=ns), NAN, INF, 1.5, 2**63, "1"),
    *each("sent_ns", lambda arm, ns: arm.point(q=HERE, sent_ns=ns), NAN, INF, 1.5, 2**63, "1"),
    *each("exact", lambda arm, flag: arm.start(**ONE, exact=flag), np.array([None]), np.zeros(2), "no", None, 2, NAN),
    *each("check", lambda arm, flag: arm.start(**ONE, check=flag), np.array([None]), np.zeros(2), "no", None, 2, NAN),
    *each("joint", lambda arm, names: arm.stream(joints=names), np.array(["joint1", "elbow"])),
    *each("interpolation", lambda arm, kind: arm.start(**ONE, interpolation=kind), "round", None),
    *each("outputs", lambda arm, on: arm.point(q=HERE, outputs={0: on}), 2, -1, NAN, None, COMPLEX, [True]),
    *each("rate_hz", lambda arm, rate: arm.chunks(rate_hz=rate), NAN, INF, 0, -1, None),
    *each("crossfade_s", lambda arm, s: arm.chunks(rate_hz=20, crossfade_s=s), NAN, INF, -1, 0.4, None),
    *each("outputs_lead_s", lambda arm, s: arm.chunks(rate_hz=20, outputs_lead_s=s), NAN, INF, -0.6, 0.6, None),
    *each("relative_to", lambda arm, base: arm.chunks(rate_hz=20, relative_to=base), "here", [], np.zeros(2)),
    ("values.*kp has 198 bytes; at most 191", "too long", parameters({"pd": {"kp": [0.125] * 31 + [100.5, 1000]}})),
    ("values.*kp", "complex", parameters({"pd": {"kp": [COMPLEX]}})),
    ("values.*kp", "ragged", parameters({"pd": {"kp": [[1], [1, 2]]}})),
    ("values.*'kkk.* has 32 bytes; at most 31", "key", parameters({"pd": {"k" * 32: 1}})),
    ("values.*'sss.* has 32 bytes; at most 31", "section", parameters({"s" * 32: {"kp": 1}})),
    ("values: 33 parameters; at most 32", "many", parameters({"pd": {f"k{i}": 1 for i in range(33)}})),
]

BAD_SENDS = [
    *each("q", lambda policy, q: policy.send(q), [HERE + COMPLEX], HERE, None),
    *each("first", lambda policy, first: policy.send([HERE], first=first), NAN, INF, None, "1"),
    *each("observed_ns", lambda policy, ns: policy.send([HERE], observed_ns=ns), NAN, INF, 1.5, 2**63, "1"),
    *each("outputs", lambda policy, on: policy.send([HERE], outputs={0: on}), [2], [NAN], [None], [[1], [1, 2]], True),
    *each("9 of them; at most 8", lambda policy, count: policy.send([HERE], outputs={i: [1] for i in range(count)}), 9),
]

BAD_SETTINGS = [
    ("priority", (-1, 1.5, 256, NAN, INF, None, COMPLEX)),
    ("lease_s", (NAN, INF, -1, 0, 0.01, 61, None)),
    ("state_s", (NAN, INF, -1, 0, 3, None)),
    ("feedback_s", (NAN, INF, -1, 61, None)),
    ("timeout_s", (NAN, INF, -1, 0, None)),
    ("name", (5, "\ud800")),
    ("key", ("/none/arm.key",)),
]


class Arguments(unittest.TestCase):
    """What the caller gives wrong is a ValueError that names the argument; nothing of it is sent."""

    def kinds(self, peer):
        return [kind for message in peer.taken if (kind := message.WhichOneof("request")) != "ping"]

    def threads(self):
        """How many connections of clients are served by a thread."""
        return [thread.name for thread in threading.enumerate()].count("tactus")

    def test_of_calls(self):
        with connected() as (arm, peer):
            for name, value, call in BAD_CALLS:
                with self.subTest(name, value=value), self.assertRaisesRegex(ValueError, f"^{name}"):
                    call(arm)
            arm.pause()  # behind all that was sent
            self.assertEqual(self.kinds(peer), ["hello", "subscribe", "pause"])

    def test_of_what_a_stream_sends(self):
        class Has9Outputs(Peer):
            def welcome(self, message):
                super().welcome(message, outputs=0b1_1111_1111, output_names=[])

        with connected(Has9Outputs) as (arm, peer):
            with arm.chunks(rate_hz=20) as policy:
                for name, value, send in BAD_SENDS:
                    with self.subTest(name, value=value), self.assertRaisesRegex(ValueError, name):
                        send(policy)
                policy.send([HERE], outputs={i: [1] for i in range(8)}, ends=np.True_)
            self.assertEqual(self.kinds(peer), ["hello", "subscribe", "lease", "chunk"])

    def test_of_connect_which_leaves_no_connection(self):
        with stand_in.stand_in() as (address, peers):
            calls = [(name, {"address": address, name: value}) for name, values in BAD_SETTINGS for value in values]
            calls += [("address", {"address": a}) for a in ("tcp:h:99999", "tcp:h:\u00b2", f"tcp:{chr(233) * 64}:1", 5)]
            for name, settings in calls:
                with self.subTest(name, value=settings[name]), self.assertRaisesRegex(ValueError, f"^{name}"):
                    tactus.connect(**settings)
            with tactus.connect(address):  # behind all that connected
                self.assertEqual(len(peers), 1)
                self.assertEqual(self.threads(), 1)

    def test_whatever_fails_while_it_connects_leaves_no_connection(self):
        class Refuses(Peer):
            def take(self, message, kind):
                if kind == "subscribe":
                    self.answer(message, pb.CODE_MAILBOX_FULL, "no")
                else:
                    super().take(message, kind)

        interrupted = mock.patch("tactus.connection.robot_of", side_effect=KeyboardInterrupt)
        for peer, within, error in (
            (Refuses, contextlib.nullcontext(), tactus.Refused),
            (Peer, interrupted, KeyboardInterrupt),
        ):
            with stand_in.stand_in(peer) as (address, _), within, self.assertRaises(error):
                tactus.connect(address)
            self.assertEqual(self.threads(), 0)

    def test_the_largest_that_are_taken(self):
        most = {"s" * 31: {f"{i:031}": "v" * 191 for i in range(32)}}
        with connected(priority=255, lease_s=60, state_s=2.0, feedback_s=0, timeout_s=2) as (arm, peer):
            arm.check(**ONE, motion_frame="x" * 63, wrench_frame="\u20ac" * 21, window=2**32 - 1)
            arm.set_parameters(most, check=True)
            arm.override(np.float32(1))
        self.assertEqual(sent(peer, "begin")[0].terms.wrench_frame, "\u20ac" * 21)
        self.assertEqual(len(sent(peer, "parameters")[0].set), 32)


if __name__ == "__main__":
    unittest.main()
