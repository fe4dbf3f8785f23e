"""Tests the page without a browser: what is served and refused, and that nothing of it disturbs the server."""

import configparser
import json
import socket
import time
import unittest

from page_bench import FOLDER, Served, wait

MOST_BROWSERS = 8


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


class PageTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.served = Served("http")
        cls.served.page()
        cls.token = cls.served.describe()["token"]

    @classmethod
    def tearDownClass(cls):
        assert cls.served.end() == 0

    def setUp(self):
        self.watcher = self.served.client("watcher")
        self.watcher.ready()

    def tearDown(self):
        self.watcher.socket.close()

    def post(self, path, body=b"", **headers):
        return self.served.ask("POST", path, body, **({"X-Tactus-Token": self.token} | headers))

    def told(self, events, path, body=b""):
        """Sends a command; returns the answers to its messages."""
        status, _, text = self.post(path, body)
        self.assertEqual(status, 202, text)
        sent = json.loads(text)
        return [events.of("answer", lambda m, n=sent["number"] + i: m["number"] == n) for i in range(sent["count"])]

    def test_files_come_with_a_policy_that_lets_nothing_of_elsewhere_in(self):
        for path in ("/", "/page.css", "/main.js", "/arm.js", "/robot.json"):
            status, headers, text = self.served.ask("GET", path)
            self.assertEqual(status, 200, path)
            self.assertTrue(text)
            self.assertIn("default-src 'none'; script-src 'self'", headers["Content-Security-Policy"])
            self.assertIn("frame-ancestors 'none'", headers["Content-Security-Policy"])
            self.assertEqual(headers["X-Content-Type-Options"], "nosniff")
            for elsewhere in ("http://", "https://", "//"):
                self.assertNotIn(f'"{elsewhere}', text.replace('"http://www.w3.org/2000/svg"', ""))

    def test_a_request_of_another_page_is_refused(self):
        here = f"127.0.0.1:{self.served.port}"
        for expected, method, path, headers in (
            (403, "GET", "/", {"Host": "tactus.example"}),
            (403, "GET", "/robot.json", {"Host": f"evil.example:{self.served.port}"}),
            (403, "GET", "/", {"Host": "127.0.0.1.evil.example"}),
            (403, "GET", "/", {"Host": "localhost:80x"}),
            (200, "GET", "/", {"Host": "localhost:9000"}),  # forwarded from there
            (403, "GET", "/", {"Origin": "http://evil.example"}),
            (403, "GET", "/", {"Origin": "null"}),
            (403, "POST", "/stop", {"Origin": f"http://localhost:{self.served.port}", "X-Tactus-Token": self.token}),
            (403, "POST", "/stop", {"Origin": f"https://{here}", "X-Tactus-Token": self.token}),
            (403, "POST", "/stop", {}),
            (403, "POST", "/stop", {"X-Tactus-Token": "0" * 32}),
            (403, "POST", f"/stop?token={self.token}", {}),  # a form of another page could send that
            (403, "GET", "/events", {}),
            (403, "GET", "/events?token=" + "0" * 32, {}),
            (405, "GET", "/stop", {"X-Tactus-Token": self.token}),
            (405, "POST", "/", {"X-Tactus-Token": self.token}),
            (405, "DELETE", "/robot.json", {}),
            (405, "OPTIONS", "/stop", {"Origin": f"http://{here}"}),
            (404, "GET", "/nothing", {}),
            (404, "GET", "/../../etc/passwd", {}),
            (404, "POST", "/lease", {"X-Tactus-Token": self.token}),
        ):
            status, _, text = self.served.ask(method, path, **{k.replace("-", "_"): v for k, v in headers.items()})
            self.assertEqual(status, expected, (method, path, headers, text))
        self.assertEqual(self.served.ask("GET", "/", Host=None)[0], 403)
        self.assertLessEqual(self.watcher.state.rung, 1)

    def test_a_body_that_is_none_is_refused(self):
        for path, body in (("/override", b""), ("/override", b"1.1"), ("/override", b"-0.1"), ("/override", b"nan"),
                           ("/override", b"0.5 "), ("/stop", b"1"), ("/override", b"0" * 10_000)):
            status, _, text = self.post(path, body)
            self.assertEqual(status, 413 if len(body) > 64 else 400, (path, body, text))

    def test_every_wire_of_the_file_is_described_and_live(self):
        description = self.served.describe()
        file = configparser.ConfigParser()
        file.read(FOLDER / "served.ini")
        outputs = {o["number"]: f"{b['name']}.{o['port']}" for b in description["blocks"] for o in b["outputs"]}
        given = {(section, key): value for section in file.sections() for key, value in file[section].items()
                 if value in outputs.values()}
        given = {("command" if section == "robot" else section, key): value for (section, key), value in given.items()}
        drawn = {(b["name"], i["port"]): outputs[i["from"]] for b in description["blocks"] for i in b["inputs"]}
        self.assertEqual(drawn, given)
        events = Events(self.served, self.token)
        values, state = events.of("ports")["values"], events.of("state")
        measured = next(number for number, name in outputs.items() if name == "robot.q")
        self.assertEqual(len(values[measured]), len(state["q"]))
        for one, other in zip(values[measured], state["q"]):
            self.assertAlmostEqual(one, other, 3)

    def test_a_command_takes_the_lease_and_gives_it_back(self):
        events = Events(self.served, self.token)
        self.assertEqual([a["status"] for a in self.told(events, "/override", b"0.5")], [0, 0, 0])
        self.watcher.until(lambda: self.watcher.state.override == 0.5)
        self.watcher.until(lambda: self.watcher.state.owner == "")
        other = self.served.client("other")
        self.assertEqual(other.ask(lease=other.pb.Lease(timeout_ms=60000)).status, 0)
        refused = self.told(events, "/override", b"1")
        self.assertEqual([a["status"] for a in refused], [110, 110, 110])
        self.assertIn("other", refused[0]["text"])
        other.ask(lease=other.pb.Lease(wish=other.pb.Lease.RELEASE))
        self.assertEqual(self.watcher.state.override, 0.5)
        self.told(events, "/override", b"1")
        self.watcher.until(lambda: self.watcher.state.override == 1.0)

    def test_stop_needs_no_lease_and_rearm_takes_the_arm_over_again(self):
        events = Events(self.served, self.token)
        other = self.served.client("owner")
        other.ask(lease=other.pb.Lease(timeout_ms=60000))
        self.assertEqual([a["status"] for a in self.told(events, "/stop")], [0])
        self.watcher.until(lambda: self.watcher.state.rung == 5)
        events.of("event", lambda event: event["name"] == "rung")
        other.ask(lease=other.pb.Lease(wish=other.pb.Lease.RELEASE))
        self.assertEqual([a["status"] for a in self.told(events, "/rearm")], [0, 0, 0])
        self.watcher.until(lambda: self.watcher.state.rung <= 1)


class HostileTest(unittest.TestCase):
    """The server serves on, and the arm is not braked."""

    def setUp(self):
        self.served = Served("hostile")
        self.served.page()
        self.token = self.served.describe()["token"]
        self.served.client().ready()

    def tearDown(self):
        client = self.served.client()
        client.ready()
        self.assertEqual(client.state.epoch, 1)
        self.assertEqual(self.served.ask("GET", "/")[0], 200)
        self.assertEqual(self.served.end(), 0)

    def connect(self, text=b""):
        to = socket.create_connection(("127.0.0.1", self.served.port), 20)
        to.sendall(text)
        return to

    def test_bytes_that_are_no_request(self):
        head = b"GET / HTTP/1.1\r\nHost: localhost\r\n"
        for text in (b"\0" * 1000, b"\r\n" * 5000, b"GET\r\n\r\n", head + b"X: " + b"x" * 40_000 + b"\r\n\r\n",
                     head + b"".join(b"X-%d: 1\r\n" % i for i in range(4000)) + b"\r\n",
                     b"GET /" + b"a" * 40_000 + b" HTTP/1.1\r\n\r\n", b"POST /override HTTP/1.1\r\nHost: localhost\r\nContent-"
                     b"Length: 99999999999999999999\r\nX-Tactus-Token: " + self.token.encode() + b"\r\n\r\n1"):
            try:
                with self.connect(text) as to:
                    to.shutdown(socket.SHUT_WR)
                    answer = b""
                    while piece := to.recv(65536):
                        answer += piece
                self.assertNotIn(b" 200 ", answer.split(b"\r\n")[0])
            except OSError:
                pass  # it was cut

    def test_a_body_without_end_is_cut(self):
        with self.connect(b"POST /override HTTP/1.1\r\nHost: localhost\r\nX-Tactus-Token: " + self.token.encode() +
                          b"\r\nContent-Length: 1000000000\r\n\r\n") as to:
            with self.assertRaises(ConnectionError):
                for _ in range(10_000):
                    to.sendall(b"0" * 65536)

    def test_connections_that_say_nothing_are_closed(self):
        idle = [self.connect(b"GET / HTTP/1.1\r\nHo") for _ in range(30)]
        for to in idle:
            to.settimeout(30)
            try:
                while to.recv(65536):
                    pass
            except ConnectionError:
                pass
            to.close()
        self.assertEqual(self.served.ask("GET", "/")[0], 200)

    def test_one_browser_too_many_is_refused_and_gets_a_place_that_is_left(self):
        browsers = [Events(self.served, self.token) for _ in range(MOST_BROWSERS)]
        for browser in browsers:
            browser.of("state")
        status, _, text = self.served.ask("GET", f"/events?token={self.token}")
        self.assertEqual((status, "close one" in text), (503, True))
        browsers.pop().socket.close()

        def again():
            browser = Events(self.served, self.token)
            browser.read()
            browsers.append(browser)
            return " 200 " in browser.text.split("\r\n")[0]

        wait(again)

    def test_a_browser_that_reads_nothing_is_cut(self):
        slow = Events(self.served, self.token, small=True)
        others = [Events(self.served, self.token) for _ in range(MOST_BROWSERS - 1)]

        def place():  # that of the slow one is the only one that comes free
            for other in others:
                other.read()
            with self.connect(f"GET /events?token={self.token} HTTP/1.1\r\nHost: localhost\r\n\r\n".encode()) as to:
                return b" 200 " in to.recv(100)

        wait(place)
        slow.socket.close()


class PlaceTest(unittest.TestCase):
    def test_a_port_that_is_taken_leaves_the_server_without_a_page(self):
        with socket.create_server(("127.0.0.1", 0)) as taken:
            served = Served("taken", taken.getsockname()[1])
            client = served.client()
            self.assertEqual(client.ask(ping=client.pb.Ping()).status, 0)
            self.assertEqual(served.end(), 0)
        self.assertIn("there is no page: Address already in use", served.said())
        self.assertIn("the server goes on", served.said())


if __name__ == "__main__":
    unittest.main()
