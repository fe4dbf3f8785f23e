#!/usr/bin/python3
"""key_press.py PROGRAM TACTUSCTL [PRESSES]: measures the time from a key press to the first changed command.

A simulated UR10 is served at 1 kHz of the wall clock, so that a late cycle delays it and does not brake it. Two clients press keys at random moments: one that sends a Velocity at
once, and `tactusctl jog` in a terminal. All of them, and this program, read the same monotonic clock. The changed command is
that of the first State whose reference has moved; if States of the cycles before it are missing, the time is the longest
that it can have been.
"""

import os
import pty
import random
import signal
import socket
import statistics
import struct
import subprocess
import sys
import tempfile
import threading
import time

sys.path.insert(0, "build/python")
from tactus import tactus_pb2 as pb


class Client:
    """A connection; a thread keeps what is told, and when it came."""

    def __init__(self, path, name):
        self.socket = socket.socket(socket.AF_UNIX)
        self.socket.connect(path)
        self.number, self.states, self.answers = 0, [], {}
        threading.Thread(target=self.listen, daemon=True).start()
        self.send(hello=pb.Hello(version=1, client=name))

    def send(self, **request):
        self.number += 1
        message = pb.ToServer(number=self.number, **request).SerializeToString()
        self.socket.sendall(struct.pack("<I", len(message)) + message)
        return self.number

    def listen(self):
        stream = self.socket.makefile("rb")
        while len(head := stream.read(4)) == 4:
            message = pb.ToClient.FromString(stream.read(struct.unpack("<I", head)[0]))
            if message.HasField("state"):
                self.states.append(message.state)
            if message.HasField("answer"):
                self.answers[message.answer.number] = time.monotonic_ns()

    def moves(self):
        return self.states != [] and max(map(abs, self.states[-1].dq_d)) > 0.0


def pressed(watcher, press):
    """Presses a key while the arm rests, and returns (cycles, seconds) until the first changed command."""
    watcher.send(ping=pb.Ping())  # a client that is silent is cut
    while not watcher.states or watcher.states[-1].rung > 1 or watcher.moves():
        time.sleep(0.01)
    time.sleep(random.uniform(0.02, 0.05))
    watcher.states.clear()
    time.sleep(random.uniform(0.01, 0.02))
    begin = time.monotonic_ns()
    press()
    end = time.monotonic() + 1.0
    while not watcher.moves() and time.monotonic() < end:
        time.sleep(0.001)
    states = list(watcher.states)
    before = [state for state in states if state.server_ns <= begin]
    after = [state for state in states if state.server_ns > begin and before and state.q_d != before[-1].q_d]
    return (after[0].cycle - before[-1].cycle, (after[0].server_ns - begin) * 1e-9) if after else None


def row(name, expected, values, unit):
    values = sorted(values)
    cuts = values[0], statistics.median(values), values[min(len(values) - 1, int(0.99 * len(values)))], values[-1]
    print(f"{name:<34} {expected:>18}" + "".join(f"{value:>9.4g}" for value in cuts) + f"  {unit}", flush=True)


def measure(path, tactusctl, presses):
    watcher, sender = Client(path, "watcher"), Client(path, "sender")
    watcher.send(subscribe=pb.Subscribe(state_ms=1))
    while not watcher.states:
        time.sleep(0.01)
    trips = []
    for _ in range(presses):
        begin = time.monotonic_ns()
        number = sender.send(ping=pb.Ping())
        while number not in sender.answers:
            time.sleep(0.0001)
        trips.append((sender.answers[number] - begin) * 1e-6)
        time.sleep(0.002)
    joints = len(watcher.states[-1].q)
    print(f"{presses} presses; a cycle is 1 ms" + " " * 22 + "expected      min   median     99 %      max")
    row("ping, there and back", "", trips, "ms")

    sender.send(lease=pb.Lease(timeout_ms=60000))
    velocity = pb.Velocity(timeout_ms=20, dq=[0.02] + [0.0] * (joints - 1))
    found = [pressed(watcher, lambda: sender.send(velocity=velocity)) for _ in range(presses)]
    report("a client's Velocity", "network", found)
    sender.send(lease=pb.Lease(wish=pb.Lease.RELEASE))

    command = [tactusctl, "jog", "--connect", "unix:" + path, "--speed", "1%", "--hold-ms", "20"]
    terminal, its_end = pty.openpty()
    jog = subprocess.Popen(command, stdin=its_end, stdout=its_end, stderr=its_end)
    threading.Thread(target=swallow, args=(terminal,), daemon=True).start()
    while watcher.states[-1].owner == "":
        time.sleep(0.01)
    found = [pressed(watcher, lambda: os.write(terminal, b"+")) for _ in range(presses)]
    os.write(terminal, b"q")
    jog.wait()
    report("a key of tactusctl jog", "network", found)


def swallow(terminal):
    try:
        while os.read(terminal, 65536):
            pass
    except OSError:
        pass


def report(name, beside, found):
    good = [each for each in found if each is not None]
    row(name, "2 + " + beside, [cycles for cycles, _ in good], "cycles")
    row("", "2 + " + beside, [seconds * 1e3 for _, seconds in good], "ms")
    if len(good) < len(found):
        print(f"{len(found) - len(good)} presses moved nothing within 1 s")


def main():
    program, tactusctl, presses = sys.argv[1], sys.argv[2], int(sys.argv[3]) if len(sys.argv) > 3 else 500
    with tempfile.TemporaryDirectory() as folder:
        path, pipeline = os.path.join(folder, "socket"), os.path.join(folder, "served.ini")
        with open("pipelines/ur10_jrg_pid.ini", encoding="utf-8") as source, open(
            pipeline, "w", encoding="utf-8"
        ) as file:
            file.write(source.read().replace("trajectories/", os.path.abspath("pipelines") + "/trajectories/"))
        command = [program, "serve", "--virtual-time", pipeline, "--listen", "unix:" + path]
        with subprocess.Popen(command, stdout=subprocess.PIPE) as serve:
            serve.stdout.readline()
            threading.Thread(target=serve.stdout.read, daemon=True).start()
            try:
                measure(path, tactusctl, presses)
            finally:
                serve.send_signal(signal.SIGINT)


if __name__ == "__main__":
    main()
