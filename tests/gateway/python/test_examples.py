"""Every example runs against the server of this board, without a terminal."""

import pathlib
import re
import subprocess
import sys
import unittest

import served

EXAMPLES = sorted(
    path for path in (served.ROOT / "gateway/python/examples").glob("*.py") if path.stat().st_mode & 0o100
)
KEYS = {"jog.py": "1+++2--q"}
# In the block of the page's program: a second later the arm still takes references, where they led it.
AFTERWARDS = """
    import time
    time.sleep(1.0)
    now = arm.state()
    assert now.rung == tactus.Rung.NOMINAL and np.abs(now.q_d - here - 0.1).max() < 1e-6, now
"""


class Examples(unittest.TestCase):
    def run_example(self, path: pathlib.Path, *arguments):
        """Returns what an example prints."""
        done = subprocess.run(
            [sys.executable, path, *arguments],
            input=KEYS.get(path.name, ""),
            capture_output=True,
            text=True,
            timeout=120,
            check=False,
        )
        self.assertEqual((done.returncode, done.stderr), (0, ""), f"{path.name}: {done.stdout}{done.stderr}")
        return done.stdout

    def test_all_run_at_an_address(self):
        with served.serve() as address:
            said = {path.name: self.run_example(path, address) for path in EXAMPLES}
        self.assertEqual(said["minimum_jerk.py"].count("succeeded"), 2)
        self.assertRegex(said["chunked_policy.py"], "chunks taken, 0 late")
        self.assertLess(float(said["diffusion_policy.py"].split()[0]), 10)
        self.assertTrue(said["jog.py"].endswith("\n"))

    @unittest.skipIf(served.ROBOT != "ur10", "the examples simulate a UR10")
    def test_without_an_address_they_run_a_simulated_ur10(self):
        self.assertIn("succeeded", self.run_example(EXAMPLES[-1]))

    def run_of_the_page(self, number, before="", after=""):
        """Runs a program of the page, by its number, and returns its lines."""
        page = (served.ROOT / "docs/python.md").read_text(encoding="utf-8")
        program = re.findall(r"^```python\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)[number]
        done = subprocess.run(
            [sys.executable, "-c", before + program + after], cwd=served.ROOT, capture_output=True, text=True, timeout=120, check=False
        )
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return [line for line in program.splitlines() if line]

    @unittest.skipIf(served.ROBOT != "ur10", "the page simulates a UR10")
    def test_the_ten_lines_of_the_page_run(self):
        self.assertLessEqual(len(self.run_of_the_page(0, after=AFTERWARDS)), 10)

    def test_the_lines_of_the_page_for_a_policy_run(self):
        with served.serve() as address:
            self.run_of_the_page(1, before=f"import tactus\naddress, policy = {address!r}, lambda q: [q] * 9\n")


if __name__ == "__main__":
    unittest.main()
