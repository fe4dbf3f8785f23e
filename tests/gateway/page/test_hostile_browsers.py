"""Tests that nothing that comes to the page disturbs the server."""

import socket
import time
import unittest

from page_bench import Events, Served, wait

MOST_BROWSERS = 8
MOST_CONNECTIONS = 24


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

    def test_a_flood_of_commands_does_not_cut_the_page_off(self):
        watching, counts, end = Events(self.served, self.token), {}, time.monotonic() + 1
        now = watching.of("state")["seen"]
        text = (f"POST /override HTTP/1.1\r\nHost: localhost\r\nX-Tactus-Token: {self.token}\r\nX-Tactus-Seen: {now}\r\n"
                "Content-Length: 1\r\n\r\n1").encode()
        while time.monotonic() < end:
            with self.connect(text) as to:
                status = to.recv(100)[9:12]
            counts[status] = counts.get(status, 0) + 1
        self.assertLessEqual(counts[b"202"], 100)
        self.assertGreater(counts[b"429"], 0)
        wait(lambda: self.served.ask("POST", "/pause", b"", X_Tactus_Token=self.token)[0] == 202)
        watching.socket.close()

    def test_senders_that_trickle_leave_a_place_in_time(self):
        slow = [self.connect(b"GET / HTTP/1.1\r\nX: ") for _ in range(MOST_CONNECTIONS)]
        ended = False
        end = time.monotonic() + 20
        while not ended:
            self.assertLess(time.monotonic(), end)
            time.sleep(0.05)
            for to in slow:
                try:
                    to.sendall(b"x")
                except OSError:
                    ended = True
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


if __name__ == "__main__":
    unittest.main()
