"""A server that does not keep to the protocol is named in a clear error, at once or after the time-out, never later."""

import socket
import struct
import time
import unittest

import numpy as np
import stand_in
import tactus
from stand_in import JOINTS, Peer
from tactus import tactus_pb2 as pb

TIMEOUT_S = 0.3


def attempt(peer, action=None, timeout_s=TIMEOUT_S):
    """Connects to a peer and acts."""
    with stand_in.stand_in(peer) as (address, _), tactus.connect(address, timeout_s=timeout_s) as arm:
        return action(arm) if action else None


def rests(arm):
    """Does nothing until the connection fails."""
    for _ in arm.watch():
        pass


def moves(arm):
    arm.move(t=[1.0], q=np.zeros((1, JOINTS)))


def until(peer, last):
    """Serves a client up to its first message of a kind."""
    kind = ""
    while kind != last:
        message = peer.read()
        kind = message.WhichOneof("request")
        peer.take(message, kind)


class Greeting(unittest.TestCase):
    def fails(self, serve, why, error=tactus.Lost):
        peer = type("Hostile", (Peer,), {"serve": serve})
        with self.assertRaisesRegex(error, why):
            attempt(peer)

    def test_no_server(self):
        with self.assertRaisesRegex(tactus.Lost, "unix:/none: No such file.*is a tactus server running there"):
            tactus.connect("unix:/none")

    def test_no_address(self):
        for address in ("", "unix:", "tcp:host", "tcp:host:x", "/path", "udp:host:1"):
            with self.subTest(address), self.assertRaisesRegex(ValueError, "write unix:/path.* or tcp:HOST:PORT"):
                tactus.connect(address)

    def test_silence(self):
        self.fails(lambda peer: peer.read() and time.sleep(2), "no welcome within 0.3 s")

    def test_the_end(self):
        self.fails(lambda peer: peer.read(), "the server has ended the connection")

    def test_the_end_within_a_message(self):
        self.fails(lambda peer: peer.read() and peer.raw(b"\x20\0\0\0half"), "ended the connection within a message")

    def test_half_a_length_and_silence(self):
        self.fails(lambda peer: peer.read() and (peer.raw(b"\x20"), time.sleep(2)), "no welcome within")

    def test_another_protocol(self):
        self.fails(lambda peer: peer.read() and peer.raw(b"HTTP/1.1 400 Bad Request\r\n\r\n"), "no tactus server")

    def test_a_message_that_cannot_be_read(self):
        self.fails(lambda peer: peer.read() and peer.raw(b"\x03\0\0\0\x0a\xff\xff"), "3 bytes cannot be read")

    def test_a_message_that_is_read_in_part(self):
        self.fails(lambda peer: peer.read() and peer.raw(b"\x02\0\0\0\x0c\x0c"), "2 bytes cannot be read")

    def test_another_version(self):
        self.fails(lambda peer: peer.welcome(peer.read(), version=99), "speaks version 99.*install the same release")

    def test_a_refused_hello(self):
        def serve(peer):
            peer.answer(peer.read(), 11, "this server speaks version 2; update the client (11)")

        self.fails(serve, "speaks version 2; update the client", tactus.Refused)

    def test_two_welcomes(self):
        def serve(peer):
            hello = peer.read()
            peer.welcome(hello)
            peer.welcome(hello)
            Peer.serve(peer)

        peer = type("Hostile", (Peer,), {"serve": serve})
        with self.assertRaisesRegex(tactus.Lost, "welcomed this client twice"):
            attempt(peer, rests)


class Service(unittest.TestCase):
    def fails(self, why, action=moves, **overrides):
        with self.assertRaisesRegex(tactus.Lost, why):
            attempt(type("Hostile", (Peer,), overrides), action)

    def test_silence_after_the_welcome(self):
        def serve(peer):
            until(peer, "subscribe")
            time.sleep(2)

        self.fails("silent for 0.3 s|no State within 0.3 s", rests, serve=serve)

    def test_silence_while_the_arm_moves(self):
        def take_end(peer, message):
            peer.report(peer.trajectory, pb.Report.STARTED)
            time.sleep(2)

        self.fails("silent for 0.3 s", take_end=take_end)

    def test_no_state(self):
        self.fails("no State within 0.3 s", lambda arm: arm.state(), state=lambda peer: None)

    def test_an_old_state_is_not_told(self):
        def asks(arm):
            while True:
                arm.state()

        def serve(peer):
            until(peer, "subscribe")

        self.fails("ended the connection", asks, serve=serve)

    def test_a_client_that_is_cut_hears_why(self):
        def take_subscribe(peer, message):
            peer.write(answer=pb.Answer(number=0, status=113, text="too many messages; send less often"))

        self.fails("ends the connection: too many messages; send less often", rests, take_subscribe=take_subscribe)

    def test_no_answer_but_states(self):
        def take(peer, message, kind):
            if kind in ("hello", "subscribe", "ping"):
                Peer.take(peer, message, kind)

        self.fails("no answer to lease within 0.3 s", take=take)

    def test_no_report(self):
        self.fails("no answer to pause within 0.3 s", lambda arm: arm.pause(), take_pause=lambda peer, message: None)

    def test_no_verdict(self):
        self.fails("no verdict on a trajectory", take_end=lambda peer, message: None)

    def test_no_credit(self):
        self.fails("no verdict on a trajectory", take_begin=lambda peer, message: None)

    def test_two_answers(self):
        def take_lease(peer, message):
            peer.answer(message)

        self.fails("answered request [0-9]+ twice", take_lease=take_lease)

    def test_two_final_reports(self):
        def take_point(peer, message):
            peer.report(message.number, pb.Report.EXECUTED)
            peer.report(message.number, pb.Report.SUPERSEDED)
            time.sleep(0.1)

        def points(arm):
            arm.point(q=np.zeros(JOINTS))
            rests(arm)

        self.fails("reported on request .*, which has ended", points, take_point=take_point)

    def test_an_outcome_that_is_none(self):
        def take_point(peer, message):
            peer.report(message.number, 99)

        self.fails("outcome 99 of request", lambda arm: arm.point(q=np.zeros(JOINTS)), take_point=take_point)

    def test_a_clock_that_is_none(self):
        def asks(arm):
            with arm.chunks(rate_hz=20) as policy:
                policy.send(np.zeros((1, JOINTS)), observed_ns=time.monotonic_ns())

        self.fails("stamps .* of no clock", asks, now=lambda peer: 2**63 - 1)

    def test_an_answer_to_nothing(self):
        self.fails(
            "answered request 99 that was never sent",
            rests,
            take_subscribe=lambda peer, message: peer.write(answer=pb.Answer(number=99)),
        )

    def test_the_end_while_the_arm_moves(self):
        def take_end(peer, message):
            peer.report(peer.trajectory, pb.Report.STARTED)
            peer.connection.shutdown(socket.SHUT_RDWR)

        self.fails("ended the connection", take_end=take_end)

    def test_a_server_that_does_not_read(self):
        def serve(peer):
            until(peer, "begin")
            peer.write(credit=pb.Credit(waypoints=1 << 30))
            while True:
                peer.state()
                time.sleep(0.01)

        def sends(arm):
            arm.move(t=np.arange(20000.0), q=np.zeros((20000, JOINTS)))

        self.fails("takes no more|no verdict|silent", sends, serve=serve)

    def test_random_bytes_at_random_places_never_hang(self):
        rng = np.random.default_rng(18)
        for trial in range(60):
            at = int(rng.integers(1, 8))
            data = rng.bytes(int(rng.integers(1, 64)))

            def take(peer, message, kind, at=at, data=data):
                if message.number == at:
                    peer.raw(struct.pack("<I", len(data)) * int(data[0] < 128) + data)
                Peer.take(peer, message, kind)

            began = time.monotonic()
            with self.subTest(trial):
                try:
                    attempt(type("Hostile", (Peer,), {"take": take}), moves, 0.2)
                except tactus.Error as error:
                    self.assertTrue(str(error))
                self.assertLess(time.monotonic() - began, 30)


if __name__ == "__main__":
    unittest.main()
