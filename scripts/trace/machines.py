"""The machines that play tapes: how the program tests/trace is built for each, and how it is started."""

import dataclasses
import os
import shutil
import subprocess
import sys

# The emulator's machine of every bare core.
BARE = {"m7": "mps2-an500", "m55": "mps3-an547"}
SILENT = ["-nographic", "-monitor", "none", "-serial", "none", "-chardev", "stdio,id=sh"]


class BuildError(Exception):
    """A program cannot be built; the message says why."""


def make(*words):
    """Runs make with these words and none of a make that started this program; raises BuildError."""
    command = ["make", "-s", "--no-print-directory", f"-j{len(os.sched_getaffinity(0))}", "KINDS=", "SANITIZE=", *words]
    environment = {name: value for name, value in os.environ.items() if name not in ("MAKEFLAGS", "MFLAGS", "MAKELEVEL")}
    if subprocess.run(command, env=environment, check=False, stdout=sys.stderr).returncode != 0:
        raise BuildError(f"{' '.join(command)} has failed")


@dataclasses.dataclass(frozen=True)
class Machine:
    """A compiler with its options, and the emulator of what it compiles for, if there is one."""

    name: str
    compiler: str = "g++"
    arch: str = "host"
    level: str = ""  # of optimisation; none: the project's own
    emulator: str = ""
    flags: str = ""

    def with_flags(self, flags):
        return dataclasses.replace(self, flags=flags)

    def variant(self):
        parts = [self.compiler if self.arch == "host" and self.level else "", self.level, self.flags.replace(" ", "")]
        return "".join(parts).replace("+", "x").replace("=", "-")

    def missing(self):
        """Returns the first tool that the machine needs and this computer lacks, or none."""
        return next((tool for tool in (self.compiler, self.emulator) if tool and not shutil.which(tool)), "")

    def build(self, robot, launcher):
        """Builds the program of a robot; raises BuildError."""
        words = [f"BOARD={robot}_sim", f"ARCH={self.arch}", f"VARIANT={self.variant()}"]
        words += [f"CXX={launcher} {self.compiler}".replace("= ", "="), f"OPTIMISED={self.level or '-O3'}", f"VARIANT_FLAGS={self.flags}"]
        make(*words, *(["WARNINGS="] if self.compiler.startswith("clang") else []), "trace")

    def command(self, robot, job):
        """Returns the command that plays a job."""
        convex = "convex" if os.environ.get("LIBCCD") else ""
        how = "".join(f"-{part}" for part in (self.arch if self.arch != "host" else "", self.variant(), convex) if part)
        program = f"build/{robot}_sim{how}/trace"
        if self.arch in BARE:
            semihosting = f"enable=on,target=native,chardev=sh,arg=trace,arg={job}"
            return [self.emulator, "-M", BARE[self.arch], *SILENT, "-semihosting-config", semihosting, "-kernel", program]
        return [self.emulator, program, str(job)] if self.emulator else [program, str(job)]


QUICK = [
    Machine("x86-64"),
    Machine("aarch64", "aarch64-linux-gnu-g++", "arm64", emulator="qemu-aarch64"),
    Machine("Cortex-M7", "arm-none-eabi-g++", "m7", emulator="qemu-system-arm"),
]
LEVELS = [(compiler, level) for compiler in ("g++", "clang++") for level in ("-O1", "-O2", "-O3")]
M55 = Machine("Cortex-M55", "arm-none-eabi-g++", "m55", emulator="qemu-system-arm")
MATRIX = QUICK + [M55] + [Machine(f"{compiler} {level}", compiler, level=level) for compiler, level in LEVELS if (compiler, level) != ("g++", "-O3")]
