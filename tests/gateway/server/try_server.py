#!/usr/bin/python3
"""try_server.py PROGRAM PIPELINE FOLDER WHAT: starts `PROGRAM serve PIPELINE` and speaks to it over its socket, with
protobuf's own Python. WHAT names the function below that is run. Prints what is wrong and ends with 1, or with 0.
"""

import json
import os
import random
import signal
import socket
import stat
import struct
import subprocess
import sys
import time

from sealed_socket import Sealed

FINAL = 10


class Client:
    def __init__(self, pb, path, name, key=None):
        self.pb, self.number, self.credit, self.state = pb, 0, 0, None
        self.answers, self.finals, self.welcome = {}, {}, None
        self.buffer = b""
        self.socket = socket.socket(socket.AF_UNIX)
        self.socket.connect(path)
        if key:
            self.socket = Sealed(self.socket, key)
        self.send(hello=pb.Hello(version=1, client=name))
        self.until(lambda: self.welcome)

    def send(self, **request):
        self.number += 1
        message = self.pb.ToServer(number=self.number, client_ns=time.monotonic_ns(), **request).SerializeToString()
        self.socket.sendall(struct.pack("<I", len(message)) + message)
        return self.number

    def read(self, timeout=0.05):
        self.socket.settimeout(timeout)
        try:
            received = self.socket.recv(65536)
        except TimeoutError:
            return
        if not received:
            raise EOFError("the server has closed the connection")
        self.buffer += received
        while len(self.buffer) >= 4 and len(self.buffer) >= 4 + struct.unpack("<I", self.buffer[:4])[0]:
            size = 4 + struct.unpack("<I", self.buffer[:4])[0]
            self.take(self.pb.ToClient.FromString(self.buffer[4:size]))
            self.buffer = self.buffer[size:]

    def take(self, message):
        kind = message.WhichOneof("message")
        inner = getattr(message, kind)
        if kind == "answer":
            assert inner.number not in self.answers, f"{inner.number} was answered twice"
            self.answers[inner.number] = inner
        elif kind == "report" and inner.outcome >= FINAL:
            assert inner.number not in self.finals, f"{inner.number} was reported twice"
            self.finals[inner.number] = inner
        elif kind == "credit":
            self.credit += inner.waypoints
        elif kind in ("state", "welcome"):
            setattr(self, kind, inner)

    def until(self, done, limit_s=60.0):
        end = time.monotonic() + limit_s
        while not done():
            assert time.monotonic() < end, "what is waited for does not come"
            self.read()

    def ask(self, **request):
        """Sends a request, and returns its answer."""
        number = self.send(**request)
        self.until(lambda: number in self.answers)
        return self.answers[number]

    def result(self, **request):
        """Sends a request that is taken, and returns its final report."""
        number = self.send(**request)
        self.until(lambda: number in self.answers)
        assert self.answers[number].status == 0, self.answers[number]
        self.until(lambda: number in self.finals)
        return self.finals[number]

    def ready(self):
        """Waits until the arm is commanded."""
        self.ask(subscribe=self.pb.Subscribe(state_ms=5))
        self.until(lambda: self.state and self.state.rung <= self.pb.RUNG_SKIP_OPTIONAL)


def swing(pb, home, count):
    """Waypoints of a small motion of the first joint, at rest at both ends, 100 Hz."""
    times, numbers = [], []
    for i in range(count):
        s = i / (count - 1)
        times.append(0.01 * i + 0.01)
        numbers += [home[0] + 0.1 * s * s * s * (10 - 15 * s + 6 * s * s)] + list(home[1:])
    return pb.Part(time_s=times, numbers=numbers)


def follow(client):
    """Sends a trajectory; returns the number of its Begin."""
    pb = client.pb
    home = list(client.state.q_d)
    goal = client.send(begin=pb.Begin(interpolation=pb.Begin.MONOTONE))
    client.until(lambda: client.credit >= 60)
    client.credit = 0
    client.send(part=swing(pb, home, 60))
    client.send(end=pb.End())
    return goal


def session(pb, serve, path):
    assert stat.S_IMODE(os.stat(path).st_mode) == 0o600, "others may connect"
    me, other = Client(pb, path, "me"), Client(pb, path, "other")
    me.ready()
    other.ready()
    assert me.welcome.takes_joints and len(me.welcome.joints) == len(me.state.q)
    assert me.ask(lease=pb.Lease(timeout_ms=30000)).status == 0
    goal = follow(me)
    me.until(lambda: goal in me.finals)
    assert me.finals[goal].outcome == pb.Report.SUCCEEDED, me.finals[goal]
    assert other.ask(resume=pb.Resume()).status == pb.CODE_NOT_OWNER
    target = list(me.state.q_d)
    assert me.result(point=pb.Point(joint=pb.JointPoint(q=target))).outcome == pb.Report.EXECUTED
    epoch = me.state.epoch
    assert other.result(stop=pb.Stop()).outcome == pb.Report.EXECUTED
    me.until(lambda: me.state.rung == pb.RUNG_DISABLED and me.state.epoch > epoch)
    assert (
        me.ask(point=pb.Point(place=pb.Place(epoch=epoch), joint=pb.JointPoint(q=target))).status == pb.CODE_EPOCH_VOID
    )
    assert me.result(rearm=pb.Rearm(stops=me.state.stops)).outcome == pb.Report.EXECUTED
    me.until(lambda: me.state.rung == pb.RUNG_NOMINAL)
    datagrams = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
    target[0] += 1e-4
    message = pb.ToServer(session=me.welcome.session, point=pb.Point(joint=pb.JointPoint(q=target)))
    datagrams.sendto(message.SerializeToString(), path + ".datagrams")
    me.until(lambda: abs(me.state.q_d[0] - target[0]) < 1e-9)


def judge_events(folder):
    """Events have the time of the log, which stands still while the drives are disabled."""
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
        events = json.load(file)["events"]
    with open(os.path.join(folder, "log.csv"), encoding="utf-8") as file:
        rows = [float(line.partition(",")[0]) for line in file.readlines()[1:]]
    rearm = next(i for i, event in enumerate(events) if event["cause"] == "rearm" and event["time_s"] > 0)
    assert events[rearm - 2]["to"] == "disabled" and events[rearm - 2]["time_s"] == events[rearm]["time_s"], events
    assert events[rearm]["time_s"] in rows, events
    assert abs(events[-1]["time_s"] - rows[-1]) < 2 * (rows[1] - rows[0]), (events, rows[-1])


def killed(pb, serve, path):
    """A client that is killed at any moment leaves the arm at rest, and the lease to others."""
    chance = random.Random(4)
    watcher = Client(pb, path, "watcher")
    watcher.ready()
    for death in range(20):
        child = os.fork()
        if child == 0:
            client = Client(pb, path, "mortal")
            client.ready()
            client.ask(lease=pb.Lease(timeout_ms=60000))
            while True:
                goal = follow(client)
                client.until(lambda: goal in client.finals)
        watcher.until(lambda: watcher.state.owner == "mortal")
        time.sleep(chance.uniform(0.0, 0.5))
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
        watcher.until(lambda: watcher.state.owner == "")
        watcher.send(ping=pb.Ping())
        watcher.until(lambda: max(abs(v) for v in watcher.state.dq_d) == 0.0)
        assert watcher.state.rung <= pb.RUNG_SKIP_OPTIONAL, watcher.state
    assert watcher.ask(lease=pb.Lease()).status == 0


def interrupted(pb, serve, path):
    """Ctrl-C ends the server while a client moves the arm; the program ends well."""
    client = Client(pb, path, "me")
    client.ready()
    client.ask(lease=pb.Lease(timeout_ms=60000))
    follow(client)
    client.until(lambda: max(abs(v) for v in client.state.dq_d) > 1e-3)


KEY = bytes(range(32))


def keyed(pb, serve, path):
    """With the key, all is as without; with another, or in plain, the server says nothing."""
    me = Client(pb, path, "me", KEY)
    me.ready()
    assert me.ask(lease=pb.Lease(timeout_ms=30000)).status == 0
    goal = follow(me)
    me.until(lambda: goal in me.finals)
    assert me.finals[goal].outcome == pb.Report.SUCCEEDED, me.finals[goal]
    for key in (bytes(32), None):
        try:
            Client(pb, path, "you", key)
            assert False, "a client without the key was welcomed"
        except (EOFError, ConnectionError):
            pass
    assert not os.path.exists(path + ".datagrams"), "datagrams are not encrypted"


def main():
    program, pipeline, folder, what = sys.argv[1:]
    subprocess.run(["protoc", "-I.", f"--python_out={folder}", "gateway/tactus.proto"], check=True)
    sys.path.insert(0, folder)
    from gateway import tactus_pb2 as pb

    path = os.path.join(folder, "arm.sock")
    out = os.path.join(folder, "out")
    command = [program, "serve", pipeline, "--listen", "unix:" + path, "--out", out]
    if what == "keyed":
        key = os.path.join(folder, "arm.key")
        with open(os.open(key, os.O_CREAT | os.O_WRONLY, 0o600), "w", encoding="ascii") as file:
            file.write(KEY.hex() + "\n")
        command += ["--key", key]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as serve:
        try:
            assert path in serve.stdout.readline(), "the first line does not name the socket"
            {f.__name__: f for f in (session, killed, interrupted, keyed)}[what](pb, serve, path)
        finally:
            serve.send_signal(signal.SIGINT)
        code = serve.wait(30)
    assert code == 0, f"exit code {code}"
    if what == "session":
        judge_events(out)
    assert not os.path.exists(path), "the socket is still there"


if __name__ == "__main__":
    main()
