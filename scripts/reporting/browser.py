"""Opens a page in Chromium without a window and takes pictures of it."""

import pathlib
import shutil
import subprocess
import tempfile

PROGRAM = "chromium"
LONGEST_S = 120
OPTIONS = (
    "--headless=new", "--no-sandbox", "--disable-background-networking", "--hide-scrollbars",
    "--force-device-scale-factor=1",
    "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",  # WebGL without a graphics card
    "--enable-logging=stderr", "--virtual-time-budget=3000",
)


class Failed(Exception):
    """The browser did not do it; the message says why."""


def is_there():
    return shutil.which(PROGRAM) is not None


def picture(page, moment, to, size):
    """Writes a PNG of the page at a moment, run=NAME&t=SECONDS; returns what its scripts said on the console."""
    address = pathlib.Path(page).resolve().as_uri() + "#" + moment
    with tempfile.TemporaryDirectory() as profile:
        command = [PROGRAM, *OPTIONS, f"--user-data-dir={profile}", f"--window-size={size[0]},{size[1]}",
                   f"--screenshot={to}", address]
        try:
            said = subprocess.run(command, capture_output=True, text=True, timeout=LONGEST_S, check=False).stderr
        except (OSError, subprocess.TimeoutExpired) as error:
            raise Failed(f"{PROGRAM}: {error}") from error
    if not pathlib.Path(to).exists():
        raise Failed(f"{PROGRAM} took no picture of {address}: {said[-500:]}")
    return [line for line in said.splitlines() if "CONSOLE" in line]
