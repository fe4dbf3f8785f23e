"""The robot of LeRobot, found and used as LeRobot does: on the simulated FER, from the wheel."""

import itertools
import sys
import threading
import time
import unittest
from unittest import mock

import lerobot_stand_in as lerobot
import numpy as np
import served
import tactus

lerobot.register_third_party_plugins()
RealTimeChunking = sys.modules["lerobot_robot_tactus"].RealTimeChunking
NAMES = [f"fer_joint{i}.pos" for i in range(1, 8)]
setUpModule = served.serve_module


def action_of(q):
    return dict(zip(NAMES, np.asarray(q).tolist()))


class OnRobot(unittest.TestCase):
    def robot(self, **settings):
        """Returns the robot, connected; the arm goes home when the test ends."""
        robot = lerobot.make_robot("tactus", id="test", address=served.address, **settings)
        robot.connect()
        self.addCleanup(served.go_home, self.enterContext(served.connect()))
        self.addCleanup(lambda: robot.is_connected and robot.disconnect())
        return robot


class Interface(OnRobot):
    def test_features_are_known_before_a_connection_and_are_what_is_observed(self):
        settings = dict(pipeline=str(served.JOINT_PIPELINE), program=str(served.PROGRAM))
        robot = lerobot.make_robot("tactus", cameras={"wrist": lerobot.CameraConfig(2, 3)}, **settings)
        self.assertEqual(robot.action_features, dict.fromkeys(NAMES, float))
        self.assertEqual(robot.observation_features, {**robot.action_features, "wrist": (2, 3, 3)})
        self.assertFalse(robot.is_connected)
        robot.connect()
        self.assertTrue(robot.is_connected and robot.is_calibrated)
        seen = robot.get_observation()
        self.assertEqual((list(seen), seen.pop("wrist")), ([*NAMES, "wrist"], "wrist"))
        self.assertLess(np.abs(list(seen.values()) - served.home).max(), 0.01)
        robot.disconnect()
        self.assertTrue(robot.cameras["wrist"].disconnect.called)
        settings["pipeline"] = str(served.TASK_PIPELINE)
        for wrong, text in ((settings, "takes poses"), (settings | {"address": "unix:x"}, "give one")):
            with self.assertRaisesRegex(ValueError, text):
                lerobot.make_robot("tactus", **wrong).connect()

    def test_what_is_sent_is_held_at_the_end_of_the_range_and_refused_beyond(self):
        robot, here = self.robot(), action_of(served.home)
        with served.connect() as arm:
            end = arm.robot.joints[6].max_rad
        self.assertEqual(robot.send_action(here | {NAMES[6]: end + 0.05}), here | {NAMES[6]: end})
        for wrong in ({}, here | {"elbow.pos": 0.0}):
            with self.assertRaisesRegex(ValueError, f"expected {NAMES[0]}"):
                robot.send_action(wrong)
        for wrong in (90.0, float("nan")):
            robot.send_action(here | {NAMES[6]: wrong})
            with self.assertRaisesRegex(tactus.Refused, "joint 7"):
                robot.disconnect()  # at the latest
            robot.connect()

    def test_it_rests_on_the_last_target_and_gives_the_lease_back(self):
        robot, goal = self.robot(), served.home + 0.1 * served.moved(7)
        with self.assertRaises(lerobot.DeviceAlreadyConnectedError):
            robot.connect()
        robot.send_action(action_of(goal))
        robot.disconnect()
        with served.connect() as arm:
            self.assertEqual((arm.state().owner, arm.state().phase), ("", tactus.Phase.HOLDING))
            self.assertLess(np.abs(arm.state().q_d - goal).max(), 1e-6)
        for call in (robot.get_observation, robot.disconnect, lambda: robot.send_action(action_of(goal))):
            with self.assertRaises(lerobot.DeviceNotConnectedError):
                call()

    def test_what_does_not_rest_in_time_is_canceled(self):
        with self.robot().connection() as robot:
            robot.act(served.home + 0.5 * served.moved(7))
            robot.rest(within_s=0.0)
            self.assertEqual(robot.arm.state().phase, tactus.Phase.HOLDING)
            self.assertLess(np.abs(robot.arm.state().q_d - served.home).max(), 0.4)

    def test_a_lost_server_is_a_device_that_is_not_connected(self):
        with served.serve() as address:
            robot = lerobot.make_robot("tactus", address=address)
            robot.connect()
        with self.assertRaises(lerobot.DeviceNotConnectedError):
            while True:
                robot.get_observation()
        self.assertFalse(robot.is_connected)
        with self.assertRaises(lerobot.DeviceNotConnectedError):
            robot.connect()

    def test_a_recorded_episode_is_replayed_on_the_same_path(self):
        phase, t = 0.4 * np.arange(7), np.linspace(0, 2 * np.pi, 201)[:, None]
        way = np.cos(phase) - np.cos(phase + t - np.sin(t))  # no joint moves in proportion to another; from rest to rest
        recorded, actions = self.episode(map(action_of, served.home + 0.1 * way * served.moved(7)))
        replayed, again = self.episode(actions)
        self.assertEqual(again, actions)
        self.assertGreater(np.ptp(recorded, axis=0)[:6].min(), 0.1)
        for one, other in ((recorded, replayed), (replayed, recorded)):
            lines = np.concatenate([np.linspace(a, b, 20) for a, b in itertools.pairwise(other)])
            away = np.abs(one[:, None] - lines).max(axis=2).min(axis=1)
            self.assertLess(np.median(away), 0.01)  # a busy computer delays some actions

    def episode(self, actions):
        """Sends actions at 50 Hz as the programs of LeRobot do; returns observations, and what was sent."""
        robot, seen, sent, begin = self.robot(), [], [], time.monotonic()
        for step, action in enumerate(actions, 1):
            seen.append(list(robot.get_observation().values()))
            sent.append(robot.send_action(action))
            time.sleep(max(0.0, begin + step / 50 - time.monotonic()))
        robot.disconnect()
        self.doCleanups()
        return np.array(seen), sent


class Chunks(OnRobot):
    STEP_NS, COUNT = 20_000_000, 30

    def policy(self, rng, t, inference_delay, prev_chunk_left_over):
        """Chunks that disagree by 15 mrad; of the last one, what is committed is kept, and then less and less."""
        intent = served.home + np.outer(0.15 * np.sin(0.8 * np.pi * t) ** 2, served.moved(7))
        if prev_chunk_left_over is None:
            return intent
        count, step = len(prev_chunk_left_over), np.arange(self.COUNT)[:, None]
        left = np.vstack([prev_chunk_left_over, intent[count:]])
        weight = np.clip((count - step) / (count - inference_delay + 1), 0, 1)
        q = weight * left + (1 - weight) * (intent + rng.normal(0, 0.015, 7))
        return np.where(step < inference_delay, left, q)

    def run_policy(self, chunking, robot):
        """Yields what is handed over before each chunk. Each takes 1 to 5 steps, at random."""
        rng, begin_ns = np.random.default_rng(5), time.monotonic_ns()
        while time.monotonic_ns() < begin_ns + 4e9:
            robot.get_observation()
            yield (given := chunking.condition())
            t = (chunking.first_ns - begin_ns + self.STEP_NS * np.arange(self.COUNT)) / 1e9
            targets = self.policy(rng, t, **given)
            due_ns = chunking.first_ns + (rng.integers(1, 6) - 0.5) * self.STEP_NS
            time.sleep(max(0, (due_ns - time.monotonic_ns()) / 1e9))
            chunking.send(targets)

    def test_the_prefix_that_is_handed_over_is_executed_to_the_bit_and_chunks_join_within_limits(self):
        robot, states = self.robot(rate_hz=50), []
        send, watching = tactus.Chunks.send, self.enterContext(served.connect(state_s=0.001))
        with mock.patch.object(tactus.Chunks, "send", autospec=True, side_effect=send) as sent:
            watch = threading.Thread(target=lambda: states.extend(itertools.takewhile(lambda _: robot.is_connected, watching.watch())))
            watch.start()
            handed = list(self.run_policy(RealTimeChunking(robot), robot))
            robot.disconnect()
            watch.join()
        last = {state.chunks_taken: state for state in states}  # before the next chunk
        in_force, seams, origin_ns = {}, [], sent.call_args_list[0].kwargs["observed_ns"]
        for taken, (call, given) in enumerate(zip(sent.call_args_list, handed, strict=True), start=min(last)):
            q, first = call.kwargs["q"], (call.kwargs["observed_ns"] - origin_ns) / self.STEP_NS
            self.assertAlmostEqual(first, round(first), delta=1e-6)  # all chunks are on the same steps
            first, before, after = round(first), last[taken], last[taken + 1]
            for k in range(given["inference_delay"]):
                self.assertEqual(given["prev_chunk_left_over"][k].tobytes(), in_force[first + k].tobytes())
            passed = after.targets_trimmed - before.targets_trimmed
            if after.chunks_late == before.chunks_late:
                in_force |= {first + k: q[k] for k in range(passed, len(q))}
            if passed <= given["inference_delay"]:
                seams.append(after.seam)
        self.assertGreater(len(seams), 10)
        self.assertLess(np.median(seams), 0.005)
        self.follows(states, {origin_ns + step * self.STEP_NS: q for step, q in in_force.items()})

    def follows(self, states, targets):
        """The reference keeps the limits in every cycle, and passes most targets by at most 5 mrad."""
        states = [state for state, after in itertools.pairwise(states) if after.cycle > state.cycle]
        q, dq, cycle, ns = (np.array([getattr(s, name) for s in states]) for name in ("q_d", "dq_d", "cycle", "stamp_ns"))
        with served.connect() as arm:
            velocity, acceleration = np.array([(joint.velocity, joint.acceleration) for joint in arm.robot.joints]).T
            dt_s = np.diff(cycle)[:, None] * arm.robot.period_s
        self.assertLessEqual((np.abs(np.diff(q, axis=0) / dt_s) / velocity).max(), 1 + 1e-6)
        self.assertLessEqual((np.abs(np.diff(dq, axis=0) / dt_s) / acceleration).max(), 1 + 1e-6)
        self.assertGreater(np.abs(dq).max(), 0.1)
        passed = [np.abs(q[np.abs(ns - at_ns).argmin()] - target).max() for at_ns, target in targets.items() if at_ns < ns[-1]]
        self.assertLess(np.median(passed), 0.005)

    def test_of_a_chunk_that_is_late_as_a_whole_nothing_is_handed_over(self):
        robot = self.robot(rate_hz=50)
        chunking, actions = RealTimeChunking(robot), np.arange(120)  # as the policy gave them, in units of its own
        for count, late_s in ((120, 0.0), (2, 0.1)):
            robot.get_observation()
            before = chunking.condition()["prev_chunk_left_over"]
            time.sleep(late_s)
            chunking.send(np.tile(served.home, (count, 1)), actions[:count])
        robot.get_observation()
        after = chunking.condition()
        self.assertEqual(after["inference_delay"], 2)
        self.assertEqual(after["prev_chunk_left_over"].tolist(), actions[-len(after["prev_chunk_left_over"]) :].tolist())
        self.assertLess(len(after["prev_chunk_left_over"]), len(before))

    def test_what_the_chunk_before_has_executed_is_not_handed_over(self):
        robot = self.robot(rate_hz=50)
        chunking = RealTimeChunking(robot, window=1)
        robot.get_observation()  # is older than the second chunk in force
        for late_s in (0.0, 0.1):
            chunking.condition()
            time.sleep(late_s)
            chunking.send(np.tile(served.home, (120, 1)), np.arange(120))
        given = chunking.condition()
        self.assertEqual(given["prev_chunk_left_over"][0], given["inference_delay"])


if __name__ == "__main__":
    unittest.main()
