"""A served robot with its page, for the tests of this folder. The environment names them: P the program, S a folder."""

import http.client
import json
import os
import pathlib
import signal
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "tests/gateway"))
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


class Served:
    """`serve` with a page at a port of its own choice, unless one is given."""

    def __init__(self, name, port=0):
        self.path = str(FOLDER / f"{name}.sock")
        self.errors = open(FOLDER / f"{name}.err", "w+", encoding="utf-8")
        command = [os.environ["P"], "serve", str(FOLDER / "served.ini"), "--virtual-time", "--listen", "unix:" + self.path,
                   "--http", f"127.0.0.1:{port}"]
        self.program = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=self.errors, text=True)
        self.lines, self.port = [], None
        while not self.lines or "serves" not in self.lines[-1]:
            self.lines.append(self.program.stdout.readline())
            assert self.lines[-1], "the program has ended"

    def page(self):
        """Returns the address of the page."""
        line = self.program.stdout.readline()
        assert line.startswith("page: http://127.0.0.1:"), line
        self.port = int(line.rsplit(":", 1)[1].strip("/\n"))
        return f"http://127.0.0.1:{self.port}/"

    def client(self, name="me"):
        """Returns a client of the gateway."""
        return try_server.Client(messages(), self.path, name)

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


def wait(done):
    """Waits until done() is true."""
    end = time.monotonic() + LONGEST_S
    while not done():
        assert time.monotonic() < end, "what is waited for does not come"
        time.sleep(0.01)
