"""Recorded angles of joints without end: through a file, tactusctl and the Python client, on a robot that has some."""

import pathlib
import subprocess
import tempfile
import unittest
import warnings

import numpy as np
import served
import tactus

TURN = 2 * np.pi
HOME = np.array([0.6, -0.62, -1.5, 1.42, 0.27, -0.56])  # of lift6, where a server and a run begin; m, then rad
UNITS = ["m"] + ["rad"] * 5
ROLL = 5  # the joint without end
CONTINUOUS = [ROLL]
CTL = served.ROOT / "build/tactusctl"


def across(seconds):
    """Rows of a motion of the roll from 140 to 220 degrees, which a recorder writes as -140; at rest at both."""
    q = np.tile(HOME, (2, 1))
    q[:, ROLL] = np.radians([140, -140])
    return dict(t=[10.0, 10.0 + seconds], q=q, dq=np.zeros((2, 6)))


def lines(seconds):
    """The same without velocities: straight lines, which turn back at the first waypoint."""
    return {name: values for name, values in across(seconds).items() if name != "dq"}


def recording(seed, way=4.0, rows=600, dt=0.02):
    """Returns times and positions of a smooth motion of all joints from home; those of CONTINUOUS go on by `way`."""
    random = np.random.default_rng(seed)
    s = np.linspace(0, 1, rows)[:, None]
    s = 10 * s**3 - 15 * s**4 + 6 * s**5
    ways = np.where(np.isin(np.arange(6), CONTINUOUS), way, 0.2) * random.choice([-1, 1], 6)
    return 2.0 + dt * np.arange(rows), HOME + s * ways


def wrapped(q, joints):
    q = q.copy()
    q[:, joints] = (q[:, joints] + np.pi) % TURN - np.pi
    return q


class Turns(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        text = served.JOINT_PIPELINE.read_text()
        (self.folder / "as_given.ini").write_text(text)
        (self.folder / "nearest.ini").write_text(text.replace("[gateway]", "[gateway]\nwrap = nearest"))

    def file(self, t, q, dq=None):
        names = ["time_s", *(f"q{i}_{unit}" for i, unit in enumerate(UNITS, 1))]
        names += [] if dq is None else [f"dq{i}_{unit}_s" for i, unit in enumerate(UNITS, 1)]
        rows = np.column_stack([t, q] if dq is None else [t, q, dq])
        path = self.folder / "t.csv"
        np.savetxt(path, rows, fmt="%.9f", delimiter=",", header=",".join(names), comments="")
        return path

    def program(self, verb, wrap, *arguments):
        command = [served.PROGRAM, verb, self.folder / f"{wrap}.ini", "--trajectory", *arguments]
        return subprocess.run(command, capture_output=True, text=True, check=False)

    def run_of(self, wrap, file):
        """Returns time and positions of the arm in a run."""
        done = self.program("run", wrap, file, "--no-figure", "--out", self.folder / "out")
        self.assertEqual(done.returncode, 0, done.stderr)
        log = np.genfromtxt(self.folder / "out/log.csv", delimiter=",", names=True)
        names = [name for name in log.dtype.names if name.startswith("robotq")][:6]
        return done, np.column_stack([log[name] for name in names])

    # Proves CSV-9.

    def test_a_run_takes_the_short_way(self):
        done, q = self.run_of("nearest", self.file(**across(10)))
        self.assertNotIn("warning", done.stderr)
        self.assertGreater(q[:, ROLL].min(), HOME[ROLL] - 0.02)
        self.assertAlmostEqual(q[-1, ROLL], np.radians(220), delta=0.02)

    def test_a_recording_runs_as_if_it_were_not_wrapped(self):
        for seed in range(3):
            t, way = recording(seed)
            turns = np.zeros(6)
            turns[CONTINUOUS] = TURN * np.random.default_rng(seed).integers(-3, 4, 1)
            _, taken = self.run_of("nearest", self.file(t, wrapped(way + turns, CONTINUOUS)))
            _, plain = self.run_of("as_given", self.file(t, way))
            np.testing.assert_allclose(taken, plain, atol=1e-4)

    # Proves IMP-3.

    def test_a_column_has_the_unit_of_its_joint(self):
        file = self.file(**across(10))
        whole = file.read_text()
        for name, wrong in (("q1_m", "q1_rad"), ("q1_m", "q1_deg"), ("dq1_m_s", "dq1_rad_s"), ("q6_rad", "q6_m")):
            file.write_text(whole.replace(name, wrong, 1))
            done = self.program("check", "as_given", file)
            self.assertEqual(done.returncode, 2)
            self.assertRegex(done.stderr, rf"{wrong}: unknown column; expected one of time_s, q1_m, q2_rad, ")
        file.write_text(whole.replace("q1_m", "q1_mm", 1).replace(",0.600000000,", ",600,"))
        self.assertEqual(self.program("check", "as_given", file).returncode, 0)

    def test_a_lift_is_told_in_metres(self):
        rows = across(10)
        for place, said in ((1.5, r"joint 1 \(lift\): position 1\.5 m exceeds 1 m \(34\); keep within the range of the joint$"),
                            (600, r"exceeds 1 m \(34\); .*: are these millimetres\?$")):
            rows["q"][1, 0] = place
            self.assertRegex(self.program("check", "nearest", self.file(**rows)).stderr.strip(), said)
        lifted = dict(t=[3, 8], q=np.vstack([HOME, HOME + [0.3, 0, 0, 0, 0, 0]]), dq=np.zeros((2, 6)))
        with served.serve() as address:
            command = [CTL, "send", "--connect", address, self.file(**lifted)]
            sent = subprocess.run(command, capture_output=True, text=True, check=True).stdout
        self.assertRegex(sent, r"largest tracking error [\d.]+ mm \(joint 1\)")

    # Proves CTL-18.

    def test_a_rounded_path_along_an_end_is_admitted(self):
        path, timed = self.folder / "path.csv", self.folder / "timed.csv"
        places = [(0.6, -0.62, -1.5), (1.0, -0.3, -1.5), (1.0, 0.0, -1.0), (0.6, 0.0, -1.0)]
        path.write_text("q1_m,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad\n" + "".join("%g,%g,%g,1.42,0.27,-0.56\n" % place for place in places))
        for how in ("--tolerance", "0.02"), ("--tolerance", "0.002"), ("--radius", "0.1"):
            subprocess.run([CTL, "retime", path, "--robot", "lift6", *how, "--out", timed], check=True, capture_output=True)
            self.assertEqual(self.program("check", "as_given", timed).returncode, 0)

    # Proves CSV-9.

    def test_joints_with_stops_are_left_alone(self):
        q = np.tile(HOME, (2, 1))
        q[:, 1] += TURN
        done = self.program("check", "nearest", self.file([5, 10], q))
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"joint 2 \(shoulder\): position 5\.66\d* rad exceeds 2\.\d* rad \(34\)")

    def test_a_pipeline_of_poses_refuses_the_setting(self):
        text = (self.folder / "nearest.ini").read_text()
        text = text[: text.index("[jrg]")] + "[trg]\ntype = task_reference_generator\nx = model.x\n[recorder]\n"
        (self.folder / "poses.ini").write_text(text.replace("pd.tau", "model.g"))
        self.assertIn("wrap", self.program("check", "poses", self.file(**across(10))).stderr)

    # Proves CSV-10.

    def test_what_is_refused_names_the_turn_and_the_setting(self):
        t, way = recording(0)
        for rows in (lines(3), dict(t=t, q=wrapped(way, CONTINUOUS))):
            done = self.program("check", "as_given", self.file(**rows))
            self.assertEqual(done.returncode, 2)
            self.assertRegex(done.stderr, r"wrist_roll goes by \S+ rad to waypoint \d+, where \S+ rad lead .*2 pi: wrap = nearest")
            self.assertEqual(done.stderr.count("\n"), 1)
            for wrong in ("more time", "degrees", "smoothing"):
                self.assertNotIn(wrong, done.stderr)

    def test_a_turn_from_the_arm_to_the_first_waypoint_is_named(self):
        q = np.tile(HOME + [0, 0, 0, 0, 0, TURN], (2, 1))
        for t, status in (((0.0, 3.0), r"\(40\)"), ((1.0, 4.0), r"\(36\)")):
            done = self.program("check", "as_given", self.file(t, q, 0 * q))
            self.assertRegex(done.stderr, status + r"; wrist_roll goes by 6\.28319 rad to waypoint 1, .*wrap = nearest")
            self.assertEqual(self.program("check", "nearest", self.file(t, q, 0 * q)).returncode, 0)

    def test_degrees_are_still_taken_for_degrees(self):
        q = np.tile(np.hstack([HOME[:1], np.degrees(HOME[1:])]), (2, 1))
        q[:, ROLL] = [140, -140]
        self.assertIn("are these degrees?", self.program("check", "as_given", self.file([5, 10], q)).stderr)
        self.assertEqual(self.program("check", "nearest", self.file([5, 10], q)).returncode, 2)

    def test_a_long_way_that_is_accepted_is_told(self):
        file = self.file(**across(20))
        for verb, more in (("check", ()), ("run", ("--no-figure", "--out", self.folder / "o"))):
            done = self.program(verb, "as_given", file, *more)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertRegex(
                done.stderr,
                r"warning: wrist_roll turns by -4\.88692 rad to waypoint 2, where 1\.39626 rad .*wrap = nearest",
            )

    # Proves CSV-9, CSV-10.

    def test_clients_ask_for_the_short_way(self):
        with served.serve() as address, tactus.connect(address) as arm:
            self.assertEqual([i for i, joint in enumerate(arm.robot.joints) if joint.continuous], CONTINUOUS)
            with self.assertRaisesRegex(tactus.Refused, "wrap = nearest") as refused:
                arm.check(**lines(3))
            self.assertNotIn("more time", str(refused.exception))
            with self.assertWarnsRegex(UserWarning, r"wrist_roll turns by -4\.886.* 1\.39626 rad"):
                arm.check(**across(20))
            with self.assertRaises(ValueError):
                arm.check(wrap="shortest", **across(10))
            near = across(10)
            near["q"][:, ROLL] += 3 * TURN
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                arm.move(wrap="nearest", **near)
                t, way = recording(3)
                streamed = dict(t=t, q=wrapped(way, CONTINUOUS), dq=np.gradient(way, t, axis=0), window=16)
                streamed["dq"][[0, -1]] = 0
                arm.check(wrap="nearest", **streamed)
            with self.assertRaisesRegex(tactus.Refused, "wrap = nearest"):
                arm.check(**streamed)
            self.assertAlmostEqual(arm.state().q_d[ROLL], np.radians(220), delta=1e-6)

    def test_tactusctl_asks_for_the_short_way(self):
        def ctl(verb, file, *options):
            command = [CTL, verb, "--connect", address, *options, file]
            return subprocess.run(command, capture_output=True, text=True, check=False)

        with served.serve() as address:
            refused = ctl("check", self.file(**lines(3)))
            self.assertEqual(refused.returncode, 2)
            self.assertIn("wrap = nearest", refused.stdout + refused.stderr)
            told = ctl("check", self.file(**across(20)))
            self.assertEqual(told.returncode, 0)
            self.assertRegex(told.stdout, r"(?m)^warning: wrist_roll turns by -4\.88692 rad")
            sent = ctl("send", self.file(**across(10)), "--wrap", "nearest")
            self.assertEqual(sent.returncode, 0, sent.stdout + sent.stderr)
            self.assertNotIn("warning", sent.stdout)
            with tactus.connect(address) as arm:
                self.assertAlmostEqual(arm.state().q_d[ROLL], np.radians(220), delta=1e-6)


if __name__ == "__main__":
    unittest.main()
