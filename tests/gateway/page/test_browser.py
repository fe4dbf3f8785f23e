"""Tests the page in Chromium without a window."""

import io
import signal
import sys
import unittest

import numpy as np
from matplotlib.image import imread
from page_bench import ROOT, Served, wait

sys.path.insert(0, str(ROOT / "scripts"))
from reporting.chromium import Chromium  # noqa: E402

COLOURS = 200  # of a picture of a shaded arm; a blank one has few
MOVED = 300  # pixels
EDGES = 100  # pixels of a box
NOMINAL = "document.getElementById('rung').textContent === 'nominal'"
BOX = "(({x, y, width, height}) => [x + scrollX, y + scrollY, width, height])(document.querySelector('%s').getBoundingClientRect())"


# The first stream of a page says nothing, not even that it has ended, like a forward that has died.
FIRST_IS_MUTE = """
window.streams = [];
window.EventSource = class extends EventSource {
  constructor(address) { super(address); this.mute = streams.push(this) === 1; }
  addEventListener(kind, hear) { super.addEventListener(kind, (event) => this.mute || hear(event)); }
  set onerror(hear) { super.onerror = (event) => this.mute || hear(event); }
};
"""


OVERRIDE_IS_SLOW = """
const fetched = fetch;
window.fetch = async (...request) => {
  const answer = await fetched(...request);
  if (request[0] === "override") await new Promise((done) => setTimeout(done, 1500));
  return answer;
};
"""


def picture_of(page, selector):
    """Returns the pixels of an element [rows, columns, 3]."""
    return imread(io.BytesIO(page.picture(*page.value(BOX % selector))))[..., :3]


def solid(picture):
    """Where the measured arm is, which is bluish; the ghost of the desired one is orange."""
    return picture[..., 2] > picture[..., 0] + 0.03


def commanded(picture):
    """Where a desired or commanded value is, which is amber; limits are red."""
    return np.all(picture[..., :2] > picture[..., 2:] + 0.25, axis=2)


def edges(picture):
    """Where the edges of a box are, which are brown; an axis is brighter."""
    red, green, blue = np.moveaxis(picture, 2, 0)
    return (red < 0.75) & (red > green + 0.15) & (red > blue + 0.2)


def moved(before, after):
    return np.count_nonzero(np.any(before != after, axis=2))


def swing(client):
    """Sends a motion of the first joint of 30 s, and gives the lease back: it goes on."""
    pb = client.pb
    home = list(client.state.q_d)
    assert client.ask(lease=pb.Lease(timeout_ms=30000)).status == 0
    client.send(begin=pb.Begin(interpolation=pb.Begin.MONOTONE))
    client.until(lambda: client.credit >= 60)
    part = pb.Part()
    for i in range(60):
        s = i / 59
        part.time_s.append(0.5 * i + 0.01)
        part.numbers.extend([home[0] + 0.8 * s * s * s * (10 - 15 * s + 6 * s * s)] + home[1:])
    assert client.ask(part=part).status == 0
    assert client.ask(end=pb.End()).status == 0
    client.until(lambda: max(abs(v) for v in client.state.dq_d) > 1e-3)
    assert client.ask(lease=pb.Lease(wish=pb.Lease.RELEASE)).status == 0


class BrowserTest(unittest.TestCase):
    def setUp(self):
        self.served = Served("browser")
        self.page = Chromium()
        self.addCleanup(self.page.__exit__)
        self.page.go(self.served.page())
        self.page.until(NOMINAL)
        self.watch()

    def watch(self):
        """Connects a client."""
        self.client = self.served.client()
        self.client.ready()

    def tearDown(self):
        self.assertEqual(self.page.said, [])
        if self.served.program.poll() is None:
            self.assertEqual(self.served.end(), 0)

    def test_the_arm_is_drawn_and_a_trajectory_is_seen(self):
        self.page.until("document.querySelector('#wires text.value').textContent.length > 0")
        self.assertEqual(self.page.value("document.querySelectorAll('#joints figure').length"), 7)
        begin = {part: picture_of(self.page, part) for part in ("#arm", "#joints figure")}
        self.assertGreater(len(np.unique(begin["#arm"].reshape(-1, 3), axis=0)), COLOURS)
        self.assertGreater(np.count_nonzero(edges(begin["#arm"])), EDGES)
        self.watch()
        swing(self.client)
        self.page.until("document.getElementById('phase').textContent === 'following'")
        self.client.until(lambda: self.client.state.q[0] > 0.1)
        plot, arm = begin["#joints figure"], solid(begin["#arm"])
        wait(lambda: moved(plot, picture_of(self.page, "#joints figure")) > MOVED)
        wait(lambda: np.count_nonzero(solid(picture_of(self.page, "#arm")) & ~arm) > MOVED)

    def test_no_command_is_drawn_while_the_drives_are_disabled(self):
        self.page.click("#quantity input[value=tau]")
        self.page.click("#stop")
        self.client.until(lambda: self.client.state.rung == 5)
        seen = []

        def band_is_wide():
            picture = picture_of(self.page, "#joints figure:nth-child(2) canvas")
            seen[:] = [picture[:, picture.shape[1] * 7 // 10 :]]  # the last 3 s
            return np.mean(np.all(seen[0] > 0.98, axis=2)) < 0.1

        wait(band_is_wide)
        self.assertEqual(np.count_nonzero(commanded(seen[0])), 0)
        self.assertTrue(self.page.value("document.querySelector('#wires.idle').textContent.includes('not commanded')"))
        self.page.click("[data-command=rearm]")
        self.page.until("!document.querySelector('#wires.idle')")

    def test_every_number_says_what_it_means_and_none_what_the_page_leaves_out(self):
        self.page.until("document.querySelector('#numbers dd').textContent.length > 0")
        told = self.page.value("[...document.querySelectorAll('#numbers dt')].map((t) => [t.textContent, t.title, t.nextSibling.textContent])")
        for name, meaning, text in told:
            self.assertTrue(meaning.endswith("."), name)
            self.assertRegex(text, r" (s|%|times)$|^once$" if name not in ("Owner", "Epoch") else ".")
        self.assertNotIn("lost", str(told).lower())

    def test_a_pipeline_with_a_sensor_has_a_button_for_its_zero(self):
        self.page.until("!document.getElementById('tare').hidden")
        self.page.click("#tare")
        self.page.until("document.getElementById('answer').textContent.startsWith('tare: ')")

    def test_stop_and_rearm_at_once_or_not_at_all(self):
        swing(self.client)
        self.page.click("#stop")
        self.client.until(lambda: self.client.state.rung == 5)
        self.page.until("document.getElementById('rung').textContent === 'disabled'")
        self.page.until("document.getElementById('events').textContent.includes('stop')")
        self.page.click("[data-command=rearm]")
        self.client.until(lambda: self.client.state.rung <= 1)
        self.page.until(NOMINAL)
        self.page.click("select, #quantity label")  # the list of a select would take the next key
        self.page.press("Escape", 27)
        self.client.until(lambda: self.client.state.rung == 5)
        self.pressed_while_the_server_hangs()

    def pressed_while_the_server_hangs(self):
        """What is pressed then is not carried out later."""
        self.page.until("document.getElementById('rung').textContent === 'disabled'")
        self.served.program.send_signal(signal.SIGSTOP)
        self.page.click("[data-command=rearm]")
        self.page.until("document.getElementById('answer').textContent === 'rearm: sending'")
        self.page.until("document.getElementById('answer').textContent === 'rearm: no answer yet; void when it comes'")
        self.page.press("Escape", 27)
        self.page.until("document.getElementById('answer').textContent === 'stop: no answer yet; carried out when the server takes it'")
        self.served.program.send_signal(signal.SIGCONT)
        self.page.until("document.getElementById('lost').hidden")
        client = self.served.client()
        client.ask(subscribe=client.pb.Subscribe(state_ms=50))
        client.until(lambda: client.state)
        self.assertEqual(client.state.rung, 5)
        self.page.said.clear()

    def test_a_stream_that_never_speaks_is_named_and_opened_anew(self):
        self.page.call("Page.addScriptToEvaluateOnNewDocument", source=FIRST_IS_MUTE)
        self.page.go(self.served.page_address)
        self.page.until("streams.length === 1 && document.getElementById('lost').textContent.includes('no state for')")
        self.assertFalse(self.page.value("document.getElementById('lost').hidden"))
        self.page.until("streams.length > 1 && document.getElementById('lost').hidden")
        self.page.until(NOMINAL)

    def assert_stopped_by_escape(self, served):
        """The page's stop reaches this server, which then ends well."""
        client = served.client()
        client.ready()
        self.page.press("Escape", 27)
        client.until(lambda: client.state.rung == 5)
        self.assertEqual(served.end(), 0)
        self.page.said.clear()

    def test_stop_reaches_a_server_that_was_started_anew_unnoticed(self):
        self.page.call("Page.addScriptToEvaluateOnNewDocument", source=FIRST_IS_MUTE + "setInterval = () => 0;")
        self.page.go(self.served.page_address)
        self.page.until("streams.length === 1")
        self.served.program.kill()
        self.served.program.wait()
        again = Served("browser", self.served.port)
        again.page()
        self.assert_stopped_by_escape(again)

    def test_the_slider_raises_the_override_unless_another_owns_the_motion(self):
        swing(self.client)
        self.page.click("#override")  # in its middle
        self.client.until(lambda: abs(self.client.state.override - 0.5) < 0.03)
        self.client.until(lambda: self.client.state.owner == "")
        rate = self.client.state.override
        self.client.ask(lease=self.client.pb.Lease(timeout_ms=60000))
        self.page.value("document.getElementById('override').focus()")
        self.page.press("End", 35)
        self.page.until("document.getElementById('answer').className === 'refused'")
        said = self.page.value("document.getElementById('answer').textContent")
        self.assertIn("override: refused: ", said)
        self.assertIn("me", said)
        self.client.send(ping=self.client.pb.Ping())
        self.page.until(f"document.getElementById('override').value === '{round(rate * 100)}'")
        self.assertEqual(self.client.state.override, rate)

    def test_what_the_buttons_do_is_an_event_and_a_slide_is_one(self):
        swing(self.client)
        self.page.until("document.getElementById('phase').textContent === 'following'")
        self.page.click("[data-command=pause]")
        self.page.until("document.getElementById('events').textContent.includes('page has paused the arm')")
        self.page.value("document.getElementById('override').focus()")
        for percent in (0, 100):
            self.page.press(*(("End", 35) if percent else ("Home", 36)))
            self.page.until(f"document.getElementById('events').textContent.includes('page has set the override to {percent} %')")
        self.page.click("[data-command=cancel]")
        self.page.until("document.getElementById('events').textContent.includes('page has canceled what runs')")
        events = self.page.value("document.getElementById('events').innerText")
        self.assertEqual(events.count("override"), 1, events)
        self.assertNotIn("page owns", events)

    def test_the_last_place_of_the_slider_counts_though_the_one_before_takes_long(self):
        self.page.call("Page.addScriptToEvaluateOnNewDocument", source=OVERRIDE_IS_SLOW)
        self.page.go(self.served.page_address)
        self.page.until(NOMINAL)
        self.page.value("document.getElementById('override').focus()")
        self.page.press("Home", 36)
        self.client.until(lambda: self.client.state.override == 0)
        self.page.press("End", 35)
        self.client.until(lambda: self.client.state.override == 1)

    def test_a_server_that_dies_is_named_loudly_and_taken_up_again(self):
        lost = "!document.getElementById('lost').hidden && document.getElementById('lost').getBoundingClientRect().height > 30"
        self.served.program.kill()
        self.served.program.wait()
        self.page.until(lost)
        self.assertIn("connection lost", self.page.value("document.getElementById('lost').textContent"))
        self.page.said.clear()  # of requests to a server that is not there
        again = Served("browser", self.served.port)
        again.page()
        self.page.until("document.getElementById('lost').hidden")
        self.page.until(NOMINAL)
        self.assert_stopped_by_escape(again)


if __name__ == "__main__":
    unittest.main()
