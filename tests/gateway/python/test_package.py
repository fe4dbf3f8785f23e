"""The package as pip installs it from the source, as the wheel of `make wheel`, and as the folder that `make python` writes."""

import importlib.util
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import served

ROOT = pathlib.Path(__file__).resolve().parents[3]
SOURCE, MADE = ROOT / "gateway/python", ROOT / "build/python/tactus"
WHEELS = ROOT / "build/wheel"
GENERATED = ["tactus_pb2.py", "tactus_pb2.pyi"]
PIP = all(importlib.util.find_spec(module) for module in ("pip", "setuptools", "wheel"))

# Drives a simulated arm: 0.1 rad further in every joint but the last, by numpy arrays.
PROGRAM = """
import pathlib, sys, numpy as np, tactus
assert not list(pathlib.Path().iterdir()) and pathlib.Path(tactus.__file__).is_relative_to(sys.prefix), tactus.__file__
pipeline, program = sys.argv[1:]
with tactus.sim(pipeline, program=program) as arm:
    here = arm.state().q_d
    goal = here + 0.1 * np.r_[np.ones(arm.robot.dof - 1), 0.0]
    assert arm.move(t=[1.0], q=goal[None], interpolation="monotone").succeeded
    assert isinstance(arm.state().q, np.ndarray) and np.abs(arm.state().q_d - goal).max() < 1e-9
"""


def run(*command, python=sys.executable, cwd=None, **environment):
    alone = {name: value for name, value in os.environ.items() if not name.startswith(("PYTHON", "PIP_"))}
    environment = {**alone, "PYTHONDONTWRITEBYTECODE": "1", **environment}
    return subprocess.run([python, *command], env=environment, cwd=cwd, capture_output=True, text=True, check=False)


def files(folder):
    return sorted(path.name for path in folder.iterdir() if path.is_file())


class Package(unittest.TestCase):
    def setUp(self):
        self.scratch = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def imports(self, folder):
        """Every public name can be had from a package in this folder, of which nothing else is on the path."""
        shown = run("-c", "import tactus; from tactus import *; print(tactus.__file__)", PYTHONPATH=str(folder))
        self.assertEqual(shown.returncode, 0, shown.stderr)
        self.assertIn(str(folder), shown.stdout)

    @unittest.skipUnless(PIP, "python3-pip is missing; scripts/setup test installs it")
    def test_pip_installs_what_make_writes_and_leaves_the_source_as_it_was(self):
        before = sorted(SOURCE.rglob("*"))
        options = ("--isolated", "install", "--no-index", "--no-build-isolation", "--root-user-action=ignore")
        done = run("-m", "pip", *options, "--prefix", self.scratch, SOURCE)  # numpy and protobuf as Debian has them
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        (installed,) = self.scratch.rglob("tactus")
        self.assertEqual(files(installed), sorted(files(SOURCE / "tactus") + GENERATED))
        self.assertIn("py.typed", files(installed))
        for name in files(installed):
            self.assertEqual((installed / name).read_bytes(), (MADE / name).read_bytes(), name)
        self.imports(installed.parent)
        self.assertEqual(sorted(SOURCE.rglob("*")), before)

    @unittest.skipUnless(PIP, "python3-pip is missing; scripts/setup test installs it")
    def test_the_wheel_drives_an_arm_from_an_empty_folder_of_a_virtual_environment(self):
        (wheel,) = WHEELS.glob("tactus-*.whl")
        environment, empty = self.scratch / "environment", self.scratch / "empty"
        empty.mkdir()
        # numpy and protobuf are Debian's, and so is pip: there is no network to fetch others from.
        run("-m", "venv", "--system-site-packages", "--without-pip", environment)
        python = environment / "bin/python"
        options = ("--isolated", "install", "--no-index", wheel)
        for command in (("-m", "pip", *options), ("-I", "-c", PROGRAM, served.JOINT_PIPELINE, served.PROGRAM)):
            done = run(*command, python=python, cwd=empty)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_the_folder_that_make_writes_may_be_copied_anywhere(self):
        shutil.copytree(MADE, self.scratch / "tactus")
        self.imports(self.scratch)

    def test_the_source_alone_says_what_is_missing(self):
        self.assertIn("run `make python`", run("-c", "import tactus", PYTHONPATH=str(SOURCE)).stderr)


if __name__ == "__main__":
    unittest.main()
