"""A served robot with its page, for the tests of this folder. The environment names them: P the program, S a folder."""

import http.client
import json
import os
import pathlib
import signal
import socket
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "tests/gateway/server"))
import try_server  # noqa: E402

FOLDER = pathlib.Path(os.environ["S"])
LONGEST_S = 60


def messages():
    """Returns the compiled messages of the gateway."""
    if not (FOLDER / "gateway/tactus_pb2.py").exists():
        subprocess.run(["protoc", "-I.", f"--python_out={FOLDER}", "gateway/tactus.proto"], check=True, cwd=ROOT)
    sys.path.insert(0, str(FOLDER))
    from gateway import tactus_pb2

    return tactus_pb2


class Client(try_server.Client):
    """Subscribes to so few states that it is not cut while a browser takes its time."""

    def ready(self):
        self.ask(subscribe=self.pb.Subscribe(state_ms=50))
        self.until(lambda: self.state and self.state.rung <= 1)


class Served:
    """`serve` with a page at a port of its own choice, unless one is given."""

    def __init__(self, name, port=0, keyed=False):
        self.path = str(FOLDER / f"{name}.sock")
        self.errors = open(FOLDER / f"{name}.err", "w+", encoding="utf-8")
        command = [os.environ["P"], "serve", str(FOLDER / "served.ini"), "--virtual-time", "--listen", "unix:" + self.path,
                   "--http", f"127.0.0.1:{port}"]
        if keyed:
            key = FOLDER / f"{name}.key"
            with open(os.open(key, os.O_CREAT | os.O_WRONLY | os.O_TRUNC, 0o600), "w", encoding="ascii") as file:
                file.write(try_server.KEY.hex() + "\n")
            command += ["--key", str(key)]
        self.program = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=self.errors, text=True)
        self.lines, self.port, self.page_address = [], None, None
        while not self.lines or "serves" not in self.lines[-1]:
            self.lines.append(self.program.stdout.readline())
            assert self.lines[-1], "the program has ended"

    def page(self):
        """Returns the address of the page."""
        line = self.program.stdout.readline()
        assert line.startswith("page: http://127.0.0.1:"), line
        self.port = int(line.rsplit(":", 1)[1].strip("/\n"))
        self.page_address = f"http://127.0.0.1:{self.port}/"
        return self.page_address

    def client(self, name="me", key=None):
        """Returns a client of the gateway."""
        return Client(messages(), self.path, name, key)

    def end(self):
        """Interrupts the program; returns its exit code."""
        self.program.send_signal(signal.SIGINT)
        code = self.program.wait(LONGEST_S)
        self.program.stdout.close()
        return code

    def said(self):
        """Returns what the program has written to its standard error."""
        self.errors.seek(0)
        return self.errors.read()

    def ask(self, method, path, body=None, **headers):
        """Returns the status, the headers and the text of an answer; a header of None is left out."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=20)
        given = {"Host": f"127.0.0.1:{self.port}"} | {name.replace("_", "-"): text for name, text in headers.items()}
        connection.putrequest(method, path, skip_host=True, skip_accept_encoding=True)
        for name, text in given.items():
            if text is not None:
                connection.putheader(name, text)
        if body is not None:
            connection.putheader("Content-Length", str(len(body)))
        connection.endheaders()
        if body is not None:
            connection.send(body)
        answer = connection.getresponse()
        result = answer.status, answer.headers, answer.read().decode()
        connection.close()
        return result

    def describe(self):
        """Returns the description of robot and pipeline."""
        return json.loads(self.ask("GET", "/robot.json")[2])


def seen(served, token):
    """Returns what a command says of the newest state."""
    events = Events(served, token)
    told = events.of("state")["seen"]
    events.socket.close()
    return told


class Events:
    """A browser's stream of events, as a socket."""

    def __init__(self, served, token, small=False):
        self.socket = socket.socket()
        if small:
            self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        self.socket.connect(("127.0.0.1", served.port))
        self.socket.settimeout(20)
        self.socket.sendall(f"GET /events?token={token} HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())
        self.text = ""

    def read(self):
        piece = self.socket.recv(65536)
        self.text += piece.decode()
        return piece

    def of(self, kind, good=lambda message: True):
        """Returns the first event of a kind that is good."""
        end = time.monotonic() + 20
        while time.monotonic() < end:
            for event in self.text.split("event: "):
                lines = event.split("\n")
                if lines[0] == kind and len(lines) > 2 and good(message := json.loads(lines[1].removeprefix("data: "))):
                    return message
            assert self.read(), "the stream has ended: " + self.text[:200]
        raise AssertionError(f"no event {kind}")


def wait(done):
    """Waits until done() is true."""
    end = time.monotonic() + LONGEST_S
    while not done():
        assert time.monotonic() < end, "what is waited for does not come"
        time.sleep(0.01)
