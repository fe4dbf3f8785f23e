"""How a server is started: with a key, and in virtual time."""

import contextlib
import pathlib
import secrets
import signal
import socket
import subprocess
import tempfile
import time
import unittest

import served
import tactus
from tactus.simulation import await_server


class Keys(unittest.TestCase):
    """A server at an address of the network, which asks for a key."""

    @classmethod
    def setUpClass(cls):
        folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.key, cls.other = folder / "arm.key", folder / "other.key"
        for file in (cls.key, cls.other):
            file.touch(mode=0o600)
            file.write_text(secrets.token_hex(32) + "\n", encoding="ascii")
        with socket.create_server(("127.0.0.1", 0)) as free:
            cls.address = f"tcp:127.0.0.1:{free.getsockname()[1]}"
        log = cls.enterClassContext(tempfile.TemporaryFile("w+"))
        command = [
            served.PROGRAM,
            "serve",
            served.JOINT_PIPELINE,
            "--virtual-time",
            "--listen",
            cls.address,
            "--key",
            cls.key,
        ]
        server = cls.enterClassContext(subprocess.Popen(command, stdout=log, stderr=log))
        cls.addClassCleanup(server.terminate)
        await_server(server, cls.address, log, cls.key)

    def test_with_the_key_the_arm_moves(self):
        with tactus.connect(self.address, key=self.key) as arm:
            path = served.swing(arm.state().q_d, 0.1, 1.0, 2000)  # parts longer than a record
            self.assertTrue(arm.move(**path).succeeded)

    def test_with_another_key_or_none_nobody_is_let_in(self):
        for key in (self.other, None):
            with self.subTest(key), self.assertRaisesRegex(tactus.Lost, "have the same key, or none"):
                tactus.connect(self.address, key=key)

    def test_a_server_without_a_key_is_named(self):
        with served.serve() as address, self.assertRaisesRegex(tactus.Lost, "does the server have a key|same key"):
            tactus.connect(address, key=self.key, timeout_s=1)

    def test_a_key_that_others_may_read_is_refused(self):
        self.other.chmod(0o644)
        with self.assertRaisesRegex(ValueError, "other.key: others may read it.*chmod 600"):
            tactus.connect(self.address, key=self.other)
        self.other.chmod(0o600)
        self.other.write_text("secret", encoding="ascii")
        with self.assertRaisesRegex(ValueError, "64 hexadecimal digits") as refused:
            tactus.connect(self.address, key=self.other)
        self.assertNotIn("secret", str(refused.exception))
        self.other.write_text(secrets.token_hex(32), encoding="ascii")


class Places(unittest.TestCase):
    def test_a_client_too_many_is_told_who_has_the_places(self):
        with served.serve() as address, contextlib.ExitStack() as clients:
            for i in range(8):
                clients.enter_context(tactus.connect(address, name=f"client {i}"))
            for _ in range(20):
                with self.assertRaisesRegex(tactus.Lost, "all places are taken; end one of these.*client 0, client 1"):
                    tactus.connect(address)


class Files(unittest.TestCase):
    def test_one_that_is_not_there_is_named(self):
        for name, files in (
            ("pipeline", dict(pipeline="/none.ini")),
            ("program", dict(pipeline=served.JOINT_PIPELINE, program="/none")),
        ):
            with self.assertRaisesRegex(ValueError, f"^{name} /none.*: No such file"):
                with tactus.serve(**files):
                    pass


class VirtualTime(unittest.TestCase):
    def rung_after_a_pause(self, *options):
        """Returns the rung of a server that was not run for 0.2 s."""
        with tempfile.TemporaryFile() as log, tempfile.TemporaryDirectory() as folder:
            command = [served.PROGRAM, "serve", served.JOINT_PIPELINE, "--listen", f"unix:{folder}/s", *options]
            with subprocess.Popen(command, stdout=log, stderr=log) as server:
                try:
                    await_server(server, f"unix:{folder}/s", log)
                    with tactus.connect(f"unix:{folder}/s") as arm:
                        server.send_signal(signal.SIGSTOP)
                        time.sleep(0.2)
                        server.send_signal(signal.SIGCONT)
                        time.sleep(0.2)
                        return arm.state().rung
                finally:
                    server.terminate()

    def test_a_late_cycle_delays_the_robot_and_does_not_brake_it(self):
        self.assertEqual(self.rung_after_a_pause("--virtual-time"), 0)

    def test_in_real_time_it_brakes(self):
        self.assertGreater(self.rung_after_a_pause(), 1)


if __name__ == "__main__":
    unittest.main()
