"""Drives Chromium without a window by its DevTools protocol, through two pipes."""

import base64
import json
import os
import shutil
import subprocess
import tempfile
import time

from reporting import browser

LONGEST_S = 60
ALONE = [option for option in browser.OPTIONS if not option.startswith("--virtual-time-budget")]


class Chromium:
    """A browser with one page."""

    def __init__(self, size=(1280, 900), dark=False):
        self.profile = tempfile.mkdtemp()
        theirs, self.to = os.pipe()
        self.of, mine = os.pipe()

        def place_pipes():  # the browser reads at 3 and writes at 4
            spare = [os.dup(theirs), os.dup(mine)]
            os.dup2(spare[0], 3)
            os.dup2(spare[1], 4)

        command = [browser.PROGRAM, *ALONE, "--remote-debugging-pipe", f"--user-data-dir={self.profile}",
                   f"--window-size={size[0]},{size[1]}", "about:blank"]
        self.process = subprocess.Popen(command, preexec_fn=place_pipes, close_fds=False, stdout=subprocess.DEVNULL,
                                        stderr=subprocess.DEVNULL)
        os.close(theirs)
        os.close(mine)
        self.number, self.buffer, self.said, self.session = 0, b"", [], None
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Runtime", "Page", "Log"):
            self.call(domain + ".enable")
        self.call("Emulation.setDeviceMetricsOverride", width=size[0], height=size[1], deviceScaleFactor=1, mobile=False)
        self.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}])

    def __enter__(self):
        return self

    def __exit__(self, *_):
        os.close(self.to)
        self.process.terminate()
        self.process.wait(30)
        shutil.rmtree(self.profile, ignore_errors=True)

    def call(self, method, **params):
        """Returns the result of a method of the protocol."""
        self.number += 1
        message = {"id": self.number, "method": method, "params": params}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.to, json.dumps(message).encode() + b"\0")
        while True:
            while b"\0" not in self.buffer:
                piece = os.read(self.of, 1 << 20)
                assert piece, "the browser has ended"
                self.buffer += piece
            text, self.buffer = self.buffer.split(b"\0", 1)
            told = json.loads(text)
            if told.get("id") == self.number:
                assert "error" not in told, told["error"]
                return told["result"]
            if told.get("method") == "Runtime.exceptionThrown":
                self.said.append(told["params"]["exceptionDetails"])
            if told.get("method") == "Log.entryAdded":
                self.said.append(told["params"]["entry"])

    def go(self, address):
        self.call("Page.navigate", url=address)

    def value(self, expression):
        """Returns the value of an expression in the page."""
        result = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        assert "exceptionDetails" not in result, result["exceptionDetails"]
        return result["result"].get("value")

    def until(self, expression):
        """Waits until an expression is true; in a page that is still loading it may throw."""
        begin = time.monotonic()
        while not (value := self.value(f"(() => {{ try {{ return {expression}; }} catch {{ return false; }} }})()")):
            assert time.monotonic() - begin < LONGEST_S, f"never true in the page: {expression}; it says {self.said}"
            time.sleep(0.02)
        return value

    def picture(self, x, y, width, height):
        """Returns a PNG of a part of the page."""
        part = {"x": x, "y": y, "width": width, "height": height, "scale": 1}
        return base64.b64decode(self.call("Page.captureScreenshot", format="png", captureBeyondViewport=True, clip=part)["data"])

    def press(self, key, code):
        for kind in ("keyDown", "keyUp"):
            self.call("Input.dispatchKeyEvent", type=kind, key=key, code=key, windowsVirtualKeyCode=code)

    def click(self, selector):
        """Presses the mouse in the middle of an element."""
        x, y = self.value(f"(() => {{ const r = document.querySelector('{selector}').getBoundingClientRect();"
                          "return [r.x + r.width / 2, r.y + r.height / 2]; })()")
        for kind in ("mousePressed", "mouseReleased"):
            self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)
