"""Tests the page without a browser: what is served and refused."""

import configparser
import json
import socket
import time
import unittest

from page_bench import FOLDER, LONGEST_S, Events, Served, seen, try_server


class PageTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.begun_s = time.monotonic()
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
        """Sends a command; returns its answer."""
        status, _, text = self.post(path, body, X_Tactus_Seen=seen(self.served, self.token))
        self.assertEqual(status, 202, text)
        sent = json.loads(text)
        return events.of("answer", lambda m: m["number"] == sent["number"])

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
            (404, "GET", "/robot.json%00.html", {}),
            (404, "POST", "/stop%00", {"X-Tactus-Token": self.token}),
            (403, "GET", "/", {"Origin": ""}),
            (400, "GET", "/", {"host": "evil.example"}),  # beside ours
            (409, "POST", "/rearm", {"X-Tactus-Token": self.token}),
            (409, "POST", "/rearm", {"X-Tactus-Token": self.token, "X-Tactus-Seen": "1"}),
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

    def test_a_box_in_a_constant_frame_is_described_where_it_is(self):
        (box,) = self.served.describe()["boxes"]
        self.assertEqual(box["name"], "table")
        corners = [box["corners"][3 * i:3 * i + 3] for i in range(8)]
        for corner, expected in ((0, (1.5, 0.3, -0.2)), (1, (1.5, 0.7, -0.2)), (2, (0.5, 0.3, -0.2)), (4, (1.5, 0.3, 0.0))):
            for one, other in zip(corners[corner], expected):
                self.assertAlmostEqual(one, other, 8)

    def test_states_and_events_have_one_origin_and_a_browser_knows_it(self):
        events = Events(self.served, self.token)
        before = events.of("state")["since_s"]
        self.served.client("passer").socket.close()
        joined = events.of("event", lambda event: event["text"] == "passer has joined")["since_s"]
        after = events.of("state", lambda state: state["since_s"] >= joined)["since_s"]
        self.assertTrue(0 <= before <= joined <= after < before + LONGEST_S, (before, joined, after))
        self.assertLess(after, time.monotonic() - self.begun_s)

    def test_a_command_takes_the_lease_and_gives_it_back(self):
        events = Events(self.served, self.token)
        self.assertEqual(self.told(events, "/override", b"0.5")["status"], 0)
        self.watcher.until(lambda: self.watcher.state.override == 0.5)
        self.watcher.until(lambda: self.watcher.state.owner == "")
        other = self.served.client("other")
        self.assertEqual(other.ask(lease=other.pb.Lease(timeout_ms=60000)).status, 0)
        refused = self.told(events, "/override", b"1")
        self.assertEqual(refused["status"], 110)
        self.assertIn("other", refused["text"])
        self.assertEqual(self.told(events, "/override", b"0.4")["status"], 0)
        other.ask(lease=other.pb.Lease(wish=other.pb.Lease.RELEASE))
        self.watcher.until(lambda: self.watcher.state.override == 0.4)
        self.told(events, "/override", b"1")
        self.watcher.until(lambda: self.watcher.state.override == 1.0)

    def test_stop_needs_no_lease_and_rearm_takes_the_arm_over_again(self):
        events = Events(self.served, self.token)
        other = self.served.client("owner")
        other.ask(lease=other.pb.Lease(timeout_ms=60000))
        self.assertEqual(self.told(events, "/stop")["status"], 0)
        self.watcher.until(lambda: self.watcher.state.rung == 5)
        events.of("event", lambda event: event["name"] == "rung")
        other.ask(lease=other.pb.Lease(wish=other.pb.Lease.RELEASE))
        self.assertEqual(self.told(events, "/rearm")["status"], 0)
        self.watcher.until(lambda: self.watcher.state.rung <= 1)

    def test_a_tare_is_taken_by_a_free_lease_and_refused_under_anothers(self):
        events, outcome = Events(self.served, self.token), ""
        end = time.monotonic() + LONGEST_S
        while outcome != "executed" and time.monotonic() < end:  # that of the start is under way
            answer = self.told(events, "/tare")
            self.assertEqual(answer["status"], 0)
            outcome = events.of("report", lambda m, number=answer["number"]: m["number"] == number)["outcome"]
        self.assertEqual(outcome, "executed")
        events.of("event", lambda event: event["name"] == "tare" and event["text"].endswith(", by page"))
        other = self.served.client("other")
        self.assertEqual(other.ask(lease=other.pb.Lease(timeout_ms=60000)).status, 0)
        self.assertEqual(self.told(events, "/tare")["status"], 110)
        other.socket.close()
        self.watcher.until(lambda: self.watcher.state.owner == "")


class PlaceTest(unittest.TestCase):
    def test_a_port_that_is_taken_leaves_the_server_without_a_page(self):
        with socket.create_server(("127.0.0.1", 0)) as taken:
            served = Served("taken", taken.getsockname()[1])
            client = served.client()
            client.ready()
            self.assertEqual(served.end(), 0)
        self.assertIn("there is no page: Address already in use", served.said())
        self.assertIn("the server goes on", served.said())

    def test_the_page_needs_no_key_and_lets_nobody_in_without(self):
        served = Served("keyed", keyed=True)
        served.page()
        browser = Events(served, served.describe()["token"])
        self.assertEqual(len(browser.of("state")["q"]), 7)
        with self.assertRaises((EOFError, ConnectionError)):
            served.client("plain")
        client = served.client("keyed", try_server.KEY)
        client.ready()
        self.assertEqual(client.state.rung, 0)
        browser.socket.close()
        self.assertEqual(served.end(), 0)


if __name__ == "__main__":
    unittest.main()
