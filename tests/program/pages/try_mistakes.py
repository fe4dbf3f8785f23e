#!/usr/bin/python3
"""try_mistakes.py PAGE: makes every mistake of a page's tables and compares what the program prints.

A row is | key: what was done | `printed` | what to do |. Its command is the `tactus ...` in the row, or else that of
its section. What is printed must match one line of the error stream, the only one, with `...` for anything. The exit
code must be 2, or as the row says; of a refusal the line must hold a remedy. PROGRAM is the environment's P; only the
sections of its board are tried. Names every row that differs and returns 1.
"""

import contextlib
import doctest
import fcntl
import os
import pathlib
import re
import resource
import shlex
import signal
import socket
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[3]
ROW = re.compile(r"^\| ([^:|]+): ([^|]+) \| `([^|]+)` \|", re.MULTILINE)
COMMAND = re.compile(r"`(tactus [^`]+)`")
BOARD = re.compile(r"board `(\w+)`")
EXIT_CODE = re.compile(r"exit code (\d)")
REMEDY = re.compile(r"; |, expected ")

HEADER = "time_s,q1_rad,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad,q7_rad\n"
READY = ",-0.785,0,-2.356,0,1.571,0.785\n"
TRAJECTORY = HEADER + "2,0" + READY + "4,0.1" + READY + "6,0" + READY
SQUARE = "time_s,x_m,y_m,z_m,qw,qx,qy,qz\n3,450,0,0.5,0,1,0,0\n"
PIPELINES = {"p.ini": "fer_jrg_pdgc.ini", "s.ini": "fer_trg_cpc.ini", "u.ini": "ur10_trg_cpc_real.ini"}
ADDRESS = "127.9.8.1"

# What each mistake changes: the file, what is replaced in it, and by what.
CHANGES = {
    "column name": ("t.csv", r"q3_rad", "q3"),
    "unit name": ("t.csv", r"q3_rad", "q3_degree"),
    "number of joints": ("t.csv", r"(?m),[^,\n]*$", ""),
    "decimal comma": ("t.csv", r"(\d)\.(\d)", r"\1,\2"),
    "not a number": ("t.csv", r"4,0\.1", "4,nan"),
    "degrees": ("t.csv", r"-0\.785,0,-2\.356,0,1\.571,0\.785", "-45,0,-135,0,90,45"),
    "times": ("t.csv", r"\n6,", "\n3,"),
    "a date": ("t.csv", r"(?m)^(\d),", r"179500000\1,"),
    "negative times": ("t.csv", r"\n2,", "\n-2,"),
    "too fast": ("t.csv", r"4,0\.1", "2.1,1.5"),
    "wrong start": ("t.csv", r"2,0,", "0,1,"),
    "unknown key": ("p.ini", r"(?m)^kp ", "Kp "),
    "missing key": ("p.ini", r"(?m)^kd .*\n", ""),
    "out of range": ("p.ini", r"(?m)^kd .*", "kd = -1"),
    "number of numbers": ("p.ini", r"(?m)^kp .*", "kp = 500 400 400 300 20 20"),
    "unknown type": ("p.ini", r"pd_gravity", "pd_gravty"),
    "used before defined": ("p.ini", r"(?s)(\[jrg\].*?)(\[pd\].*?)(?=\[recorder\])", r"\2\1"),
    "wrong quantity": ("p.ini", r"jrg\.q_d", "robot.dq"),
    "another robot": ("p.ini", r"= fer\n", "= ur10\n"),
    "another board": ("p.ini", r"\[recorder\]", f"[ur]\naddress = {ADDRESS}\n\n[recorder]"),
    "connection refused": ("u.ini", r"192\.168\.1\.10", ADDRESS),
    "no answer": ("u.ini", r"192\.168\.1\.10", f"{ADDRESS}\nconnect_ms = 500"),
    "a name for the address": ("u.ini", r"192\.168\.1\.10", "robot.local"),
}


def write_files(folder, key):
    """Writes the files of a row with its mistake."""
    files = {name: (ROOT / "pipelines" / source).read_text(encoding="utf-8") for name, source in PIPELINES.items()}
    files["p.ini"] = re.sub(r"\[gateway\]\n.*\n", "", files["p.ini"])
    files["t.csv"] = SQUARE if key == "millimetres" else TRAJECTORY
    if key == "decimal comma, semicolons":
        files["t.csv"] = TRAJECTORY.replace(",", ";").replace(".", ",")
    if key in CHANGES:
        name, old, new = CHANGES[key]
        changed = re.sub(old, new, files[name])
        if changed == files[name]:
            raise ValueError(f"{key}: {old} is not in {name}")
        files[name] = changed
    files.pop({"no file": "t.csv", "no pipeline": "p.ini"}.get(key), None)
    for name, text in files.items():
        (folder / name).write_text(text, encoding="utf-8")
    (folder / "trajectories").symlink_to(ROOT / "pipelines/trajectories")


@contextlib.contextmanager
def surroundings(folder, key):
    """What is around the program of a row: a run in the folder, or a machine that says nothing."""
    with contextlib.ExitStack() as stack:
        if key == "folder in use":
            (folder / "o").mkdir()
            descriptor = os.open(folder / "o", os.O_RDONLY)
            stack.callback(os.close, descriptor)
            fcntl.flock(descriptor, fcntl.LOCK_EX)
        if key == "no answer":
            stack.enter_context(socket.create_server((ADDRESS, 30004)))
        yield


def small_disk():
    """Lets no file of the program become larger than 64 KiB."""
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (65536, 65536))


def run(command, folder, key):
    """Returns what the program wrote to the error stream, and its exit code."""
    words = [pathlib.Path(os.environ["P"]).resolve(), *shlex.split(command)[1:]]
    if key == "Ctrl-C":
        words += ["--duration", "1000000"]
    pipes = {"stdin": subprocess.DEVNULL, "stdout": subprocess.DEVNULL, "stderr": subprocess.PIPE, "text": True}
    before = small_disk if key == "disk full" else None
    with subprocess.Popen(words, cwd=folder, preexec_fn=before, **pipes) as process:
        if key == "Ctrl-C":
            wait_for_cycles(process, folder / "o/log.csv")
            process.send_signal(signal.SIGINT)
        return process.communicate()[1], process.returncode


def wait_for_cycles(process, log):
    """Waits until a run has written to its log, or has ended."""
    while process.poll() is None and (not log.exists() or log.stat().st_size < 65536):
        time.sleep(0.01)


def try_row(command, key, done, printed):
    """Returns how the program's answer differs from that of the row, or ""."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        write_files(folder, key)
        with surroundings(folder, key):
            said, code = run(command, folder, key)
    stated = EXIT_CODE.search(done)
    expected_code = int(stated[1]) if stated else 2
    if not doctest.OutputChecker().check_output(f"{printed}\n", said, doctest.ELLIPSIS) or said.count("\n") != 1:
        return f"{key}:\n  expected {printed}\n  got      {said.strip()}\n"
    if expected_code == 2 and not REMEDY.search(printed):
        return f"{key}: the line has no remedy: {printed}\n"
    return "" if code == expected_code else f"{key}: exit code {code}, expected {expected_code}\n"


def rows(page, board):
    """Yields (command, key, what was done, what is printed) of the sections of a board; other boards are named."""
    for section in page.split("\n## ")[1:]:
        title, _, body = section.partition("\n")
        named = BOARD.search(title)
        if (named[1] if named else "fer_sim") != board:
            continue
        common = COMMAND.search(body.partition("\n|")[0])
        for row in ROW.finditer(body):
            command = COMMAND.search(row[2]) or common
            yield command[1], row[1], row[2], row[3]


def main():
    page = pathlib.Path(sys.argv[1]).read_text(encoding="utf-8")
    board = pathlib.Path(os.environ["P"]).resolve().parent.name.partition("-")[0]
    complaints = [try_row(*row) for row in rows(page, board)]
    if not complaints:
        complaints = [f"{sys.argv[1]}: no mistake for the board {board}\n"]
    print("".join(complaints), end="", file=sys.stderr)
    print(f"{len(complaints)} mistakes made")
    return 1 if any(complaints) else 0


if __name__ == "__main__":
    sys.exit(main())
