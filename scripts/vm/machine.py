"""The virtual machine: QEMU with a clock that counts instructions, so that two runs of an image give the same bytes."""

import pathlib
import re
import subprocess
import sys
import tarfile
import time

from vm.tools import found

EXIT = re.compile(r"^can-vm: exit code (\d+)\r?$", re.MULTILINE)
TIMES = re.compile(r"^can-vm: (command|ended) after ([\d.]+) s\r?$", re.MULTILINE)
LOOK_S = 0.02  # the interval at which output is passed on
CARD_BYTES = 1 << 28  # a power of 2, as a card has; only what is written takes room on the disk
KERNEL_OPTIONS = "quiet panic=-1 oops=panic cryptomgr.notests"
OUT_OF_TIME, BROKEN = 124, 125


class Broken(Exception):
    """The machine did not get to the command's end; has the exit code."""

    def __init__(self, text, code):
        super().__init__(text)
        self.code = code


def arguments(machine, kernel, folder, buses, fd):
    """Returns QEMU's command line; files instead of pipes, since a full pipe would stop the guest for a while."""
    emulator, *board = machine.qemu.format(kernel=kernel).split()
    line = [found(emulator), *board, "-accel", "tcg"]
    line += ["-icount", "shift=0,sleep=off", "-rtc", "base=2020-01-01,clock=vm", "-seed", "1"]
    line += ["-nodefaults", "-no-user-config", "-display", "none", "-no-reboot"]
    line += ["-kernel", kernel / "vmlinux", "-initrd", folder / "image"]
    line += ["-append", f"{KERNEL_OPTIONS} {machine.append}"]
    line += [word.format(folder=folder) for word in machine.ports.split()]
    for bus in range(buses):
        line += ["-object", f"can-bus,id=bus{bus}"]
        if fd:
            line += ["-device", f"ctucan_pci,canbus0=bus{bus},canbus1=bus{bus}"]
        else:
            line += ["-device", f"kvaser_pci,canbus=bus{bus}"] * 2
    return line


def passed_on(file):
    """Writes what is new in the file to our output."""
    if new := file.read():
        sys.stdout.buffer.write(new)
        sys.stdout.buffer.flush()


def run(machine, kernel, folder, buses, fd, longest_s):
    """Runs the image in the folder, passes its output on, and returns the exit code of its command and two times."""
    output, console = folder / "output", folder / "console"
    output.touch()
    with open(folder / "results", "wb") as results:
        results.truncate(CARD_BYTES)
    with open(folder / "qemu", "wb") as said, open(output, "rb") as shown:
        line = arguments(machine, kernel, folder, buses, fd)
        qemu = subprocess.Popen(["setpriv", "--pdeathsig", "KILL", *line], stdin=subprocess.DEVNULL, stdout=said, stderr=said)
        deadline = time.monotonic() + longest_s
        try:
            while qemu.poll() is None and time.monotonic() < deadline:
                time.sleep(LOOK_S)
                passed_on(shown)
        finally:
            late = qemu.poll() is None
            qemu.kill()
            qemu.wait()
        passed_on(shown)
    text = console.read_text(errors="replace") if console.exists() else ""
    if late:
        raise Broken(f"not at its end after {longest_s} s; --timeout sets more", OUT_OF_TIME)
    if not (code := EXIT.search(text)):
        raise Broken(f"the machine failed:\n{(folder / 'qemu').read_text(errors='replace')}{text}", BROKEN)
    return int(code[1]), dict(TIMES.findall(text))


def bring_out(folder, to):
    """Unpacks what the command left in /out, as files of now: the machine's clock is that of 2020, the same in every boot."""
    with tarfile.open(folder / "results") as archive:
        members = [member for member in archive if member.isfile() or member.isdir()]
        for member in members:
            member.mtime = time.time()
            if not (to / member.name).resolve().is_relative_to(to.resolve()):
                raise Broken(f"a result is called {member.name}", BROKEN)
        to.mkdir(parents=True, exist_ok=True)
        archive.extractall(to, members)
