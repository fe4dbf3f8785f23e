"""Parameters that a program changes while the pipeline of the simulated robot of this board runs."""

import time
import unittest

import numpy as np
import served
import tactus
from served import connect


setUpModule = served.serve_module


class Parameters(unittest.TestCase):
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
            owner.resume()  # takes the lease
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

    def test_the_longest_that_are_taken_do_not_end_the_connection(self):
        longest = {"s" * 31: {f"{i:031}": "v" * 191 for i in range(32)}}
        with connect() as arm:
            motion = arm.start(**served.swing(arm.state().q_d, 0.2, 1.0))
            for bad, error in ((longest, tactus.Refused), ({"pd": {"kp": [1 / 3] * 20}}, ValueError)):
                with self.assertRaises(error):
                    arm.set_parameters(bad)
            self.assertTrue(motion.wait().succeeded)

    def test_gains_change_while_the_arm_moves(self):
        with connect() as arm:
            kp = self.gain(arm)
            motion = arm.start(**served.swing(arm.state().q_d, 0.2, 2.0))
            for factor in (0.7, 1.4, 1.0):
                time.sleep(0.3)
                arm.set_parameters({kp.section: {"kp": factor * kp.numbers}})
            self.assertTrue(motion.wait().succeeded)
            self.assertEqual(arm.state().rung, 0)
