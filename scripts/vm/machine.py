"""The virtual machine: QEMU with a clock that counts instructions, so that two runs of an image give the same bytes."""

import pathlib
import re
import subprocess
import sys
import tarfile
import time

from vm.image import found

EXIT = re.compile(r"^can-vm: exit code (\d+)\r?$", re.MULTILINE)
TIMES = re.compile(r"^can-vm: (command|ended) after ([\d.]+) s\r?$", re.MULTILINE)
LOOK_S = 0.02  # the interval at which output is passed on
MEMORY_MB = 512
KERNEL_OPTIONS = [
    "console=ttyS0", "quiet", "panic=-1", "oops=panic",
    # Calibrations and self-tests, which take a kernel under emulation twice as long as all the rest. A counter that
    # counts instructions needs none: 1 GHz. The timer in the processor would be measured, that of the board need not.
    "cryptomgr.notests", "tsc_early_khz=1000000", "nolapic_timer", "initcall_blacklist=hpet_init",
]  # fmt: skip
OUT_OF_TIME, BROKEN = 124, 125


class Broken(Exception):
    """The machine did not get to the command's end; has the exit code."""

    def __init__(self, text, code):
        super().__init__(text)
        self.code = code


def arguments(kernel, folder, buses, fd):
    """Returns QEMU's command line; files instead of pipes, since a full pipe would stop the guest for a while."""
    line = [found("qemu-system-x86_64"), "-accel", "tcg", "-cpu", "qemu64", "-smp", "1", "-m", str(MEMORY_MB)]
    line += ["-icount", "shift=0,sleep=off", "-rtc", "base=2020-01-01,clock=vm", "-seed", "1"]
    line += ["-nodefaults", "-no-user-config", "-display", "none", "-no-reboot"]
    line += ["-kernel", kernel / "vmlinux", "-initrd", folder / "image"]
    line += ["-append", " ".join(KERNEL_OPTIONS)]
    line += ["-serial", f"file:{folder / 'console'}", "-serial", f"file:{folder / 'output'}"]
    line += ["-device", "virtio-serial", "-chardev", f"file,id=results,path={folder / 'results'}"]
    line += ["-device", "virtserialport,chardev=results"]
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


def run(kernel, folder, buses, fd, longest_s):
    """Runs the image in the folder, passes its output on, and returns the exit code of its command and two times."""
    output, console = folder / "output", folder / "console"
    output.touch()
    with open(folder / "qemu", "wb") as said, open(output, "rb") as shown:
        line = arguments(kernel, folder, buses, fd)
        qemu = subprocess.Popen(line, stdin=subprocess.DEVNULL, stdout=said, stderr=said)
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
    """Unpacks what the command left in /out."""
    with tarfile.open(folder / "results") as archive:
        members = [member for member in archive if member.isfile() or member.isdir()]
        for member in members:
            if not (to / member.name).resolve().is_relative_to(to.resolve()):
                raise Broken(f"a result is called {member.name}", BROKEN)
        to.mkdir(parents=True, exist_ok=True)
        archive.extractall(to, members)
