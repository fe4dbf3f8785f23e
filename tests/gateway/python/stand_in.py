"""StandIn: a server written from tactus.proto alone, which tests make misbehave.

It shares no code with the client: it frames, reads and writes raw protobuf messages. `Peer.serve` keeps to the
protocol; a test overrides what it wants wrong.
"""

import contextlib
import os
import socket
import struct
import tempfile
import threading
import time

from tactus import tactus_pb2 as pb

JOINTS = 6
ZERO = [1.0, -2.0, 3.0, 0.1, 0.2, -0.3]  # of a tare
OFFSET_NS = 7_000_000_000_000  # of the stand-in's clock, so that forgotten conversions are seen
ENDS = {"cancel", "override", "pause", "resume", "stop", "rearm", "parameters"}


class Peer:
    """The server's end of one connection. `taken` holds all that the client has sent."""

    window, longest_part = 512, 60

    def __init__(self, connection):
        self.connection = connection
        self.taken = []
        self.epoch = 1
        self.cycle = 0
        self.differs = {}
        self.trajectory = None  # number of its Begin
        self.waypoints = 0
        self.numbers = []
        self.times = []

    def now(self):
        return time.monotonic_ns() + OFFSET_NS

    def read(self):
        """Returns the next message of the client, None at its end."""
        head = self.connection.recv(4, socket.MSG_WAITALL)
        if len(head) < 4:
            return None
        (length,) = struct.unpack("<I", head)
        body = self.connection.recv(length, socket.MSG_WAITALL)
        message = pb.ToServer()
        message.ParseFromString(body)
        self.taken.append(message)
        return message

    def write(self, **message):
        body = pb.ToClient(**message).SerializeToString()
        self.raw(struct.pack("<I", len(body)) + body)

    def raw(self, data):
        with contextlib.suppress(OSError):
            self.connection.sendall(data)

    def serve(self):
        while (message := self.read()) is not None:
            self.take(message, message.WhichOneof("request"))

    def take(self, message, kind):
        """Does with a message what the protocol says."""
        if kind == "hello":
            self.welcome(message)
            self.state()
            return
        self.answer(message)
        self.state()
        getattr(self, "take_" + kind, self.take_other)(message)

    def take_other(self, message):
        kind = message.WhichOneof("request")
        if kind in ENDS or kind in ("point", "velocity", "chunk"):
            self.report(message.number, pb.Report.EXECUTED)

    def take_begin(self, message):
        self.trajectory, self.waypoints = message.number, 0
        self.write(credit=pb.Credit(waypoints=self.window))

    def take_part(self, message):
        self.waypoints += len(message.part.time_s)
        self.times.extend(message.part.time_s)
        self.numbers.extend(message.part.numbers)
        if self.waypoints >= self.window:
            self.report(self.trajectory, pb.Report.STARTED)
            self.write(credit=pb.Credit(waypoints=len(message.part.time_s)))

    def take_end(self, message):
        self.report(self.trajectory, pb.Report.STARTED)
        self.feedback()
        self.report(self.trajectory, pb.Report.SUCCEEDED, time_s=3.0, stretch=0.05)

    def take_stop(self, message):
        self.epoch += 1
        self.report(message.number, pb.Report.EXECUTED)
        self.state()

    def take_tare(self, message):
        self.report(message.number, pb.Report.EXECUTED, zero=ZERO)

    def welcome(self, message, **changed):
        joints = [
            pb.Joint(name=f"joint{i}", min_rad=-3, max_rad=3, velocity=2, acceleration=5, jerk=50, effort=100)
            for i in range(JOINTS)
        ]
        fields = dict(
            number=message.number,
            version=pb.VERSION_PRESENT,
            board="stand_in",
            robot="ur10",
            pipeline="none",
            configuration=42,
            session=7,
            server_ns=self.now(),
            client_ns=message.client_ns,
            period_s=0.001,
            joints=joints,
            takes_joints=True,
            takes_poses=True,
            longest_chunk=128,
            window=self.window,
            longest_part=self.longest_part,
            outputs=0b1001,
            output_names=["gripper", "lamp"],
            epoch=self.epoch,
        )
        self.write(welcome=pb.Welcome(**{**fields, **changed}))

    def answer(self, message, status=0, text=""):
        now = self.now()
        self.write(
            answer=pb.Answer(
                number=message.number,
                status=status,
                text=text,
                client_ns=message.client_ns,
                server_ns=now,
                received_ns=now,
                epoch=self.epoch,
            )
        )

    def report(self, number, outcome, **fields):
        self.write(report=pb.Report(number=number, outcome=outcome, server_ns=self.now(), **fields))

    def state(self, **fields):
        """Sends the state; what differs from a robot at rest stays so, as messages are answered with a state too."""
        self.cycle += 1
        self.differs.update(fields)
        self.write(
            state=pb.State(
                server_ns=self.now(),
                cycle=self.cycle,
                epoch=self.epoch,
                override=1,
                q=[0.5] * JOINTS,
                dq=[0] * JOINTS,
                tau=[0] * JOINTS,
                **self.differs,
            )
        )

    def feedback(self):
        point = pb.JointPoint(q=[1.0] * JOINTS)
        told = dict(number=self.trajectory, time_s=1.5, path_s=0.5, path_end_s=2.5)
        self.write(feedback=pb.Feedback(joint_desired=point, joint_actual=point, **told))


@contextlib.contextmanager
def stand_in(peer=Peer):
    """Serves on a private socket; yields its address and the list of the peers that have connected."""
    folder = tempfile.mkdtemp(prefix="tactus-test-")
    path = f"{folder}/socket"
    listener = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
    listener.bind(path)
    listener.listen()
    peers = []

    def attend(one):
        with contextlib.suppress(OSError):
            one.serve()
        one.connection.close()

    def accept():
        with contextlib.suppress(OSError):
            while True:
                peers.append(peer(listener.accept()[0]))
                threading.Thread(target=attend, args=(peers[-1],), daemon=True).start()

    threading.Thread(target=accept, daemon=True).start()
    try:
        yield f"unix:{path}", peers
    finally:
        listener.close()
        for one in peers:
            with contextlib.suppress(OSError):
                one.connection.shutdown(socket.SHUT_RDWR)
        os.unlink(path)
        os.rmdir(folder)
