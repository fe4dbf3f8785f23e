#!/usr/bin/python3
"""try_tutorial.py PAGE: runs the shell commands of a page in a fresh folder and compares what they print.

A block ```sh is run; the block ```text behind it is what it must print, with `...` for anything, as in Python's
doctest. A block of commands without one must print nothing. The last command of a block must end with 0. PROGRAM is
the program of fer_sim. Names the first block that differs and returns 1.
"""

import doctest
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[3]
FENCE = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
FLAGS = doctest.ELLIPSIS


def steps(text):
    """Yields (line, commands, expected output) for each block of commands."""
    blocks = [(text.count("\n", 0, fence.start()) + 1, fence[1], fence[2]) for fence in FENCE.finditer(text)]
    for number, (line, language, body) in enumerate(blocks):
        if language != "sh":
            continue
        follows = blocks[number + 1] if number + 1 < len(blocks) else (0, "", "")
        yield line, body, follows[2] if follows[1] == "text" else ""


def prepare(folder, program):
    """Makes the folder look like that of the project after make."""
    (folder / "build").mkdir()
    (folder / "build/fer_sim").symlink_to(pathlib.Path(program).resolve().parent)
    (folder / "build/python").symlink_to(ROOT / "build/python")
    for name in ("pipelines", "scripts", "examples"):
        (folder / name).symlink_to(ROOT / name)


def try_page(page, folder):
    """Returns what the first block that is not as the page says printed, or "" if all are."""
    checker = doctest.OutputChecker()
    count = 0
    for count, (line, commands, expected) in enumerate(steps(page.read_text(encoding="utf-8")), 1):
        done = subprocess.run(["sh", "-c", commands], cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, check=False)
        example = doctest.Example(commands, expected)
        printed = "".join(row for row in done.stdout.splitlines(True) if not row.startswith("  ...   "))  # of a slow computer
        if done.returncode:
            return f"{page}:{line}: exit code {done.returncode}\n{done.stdout}"
        if not checker.check_output(expected, printed, FLAGS):
            return f"{page}:{line}:\n{checker.output_difference(example, printed, FLAGS)}"
    return "" if count else f"{page}: no commands"


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        prepare(folder, os.environ["P"])
        complaint = try_page(pathlib.Path(sys.argv[1]), folder)
    print(complaint, end="", file=sys.stderr)
    return 1 if complaint else 0


if __name__ == "__main__":
    sys.exit(main())
