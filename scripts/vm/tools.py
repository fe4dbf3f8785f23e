"""Programs of a machine with the libraries that they need: the host's own or, of another architecture, Debian's,
downloaded once and never installed."""

import os
import pathlib
import re
import shutil
import struct
import subprocess
import tempfile

from vm.kernel import Missing, download, locked
from vm.machines import ELF_MACHINES, TRIPLETS

NAMES = ["busybox", "dash", "ip", "chrt", "candump", "cansend", "cangen", "canplayer"]
PACKAGES = ["busybox-static", "dash", "iproute2", "util-linux", "can-utils",
            # and what they need
            "libc6", "libbpf1", "libbsd0", "libcap2", "libelf1", "libmd0", "libmnl0", "zlib1g"]  # fmt: skip
HOST = pathlib.Path("/")
INTERPRETER = re.compile(r"program interpreter: (\S+)\]")
NEEDED = re.compile(r"\(NEEDED\)[^[]*\[(\S+)\]")


def found(tool, root=HOST):
    """Returns the path of a program below root."""
    path = shutil.which(tool, path=":".join(str(root / folder) for folder in ("bin", "usr/bin", "sbin", "usr/sbin")))
    if not path:
        raise Missing(f"{tool} is not installed; as root: scripts/setup vm")
    return pathlib.Path(path)


def host_architecture():
    return subprocess.run(["dpkg", "--print-architecture"], capture_output=True, text=True, check=True).stdout.strip()


def fetch(cache, architecture):
    """Returns the folder below which the tools of NAMES are."""
    if architecture == host_architecture():
        return HOST
    tools = cache / architecture / "tools"
    with locked(cache):
        if not tools.is_dir():
            tools.parent.mkdir(exist_ok=True)
            with tempfile.TemporaryDirectory(dir=cache) as name:
                download(pathlib.Path(name), lambda: [f"{each}:{architecture}" for each in PACKAGES]).rename(tools)
    return tools


class Libraries:
    """Finds the shared libraries of an architecture: below root, then on the host, then in folders of the project."""

    def __init__(self, architecture, root, folders):
        self.architecture = architecture
        triplet = TRIPLETS[architecture]
        system = [f"lib/{triplet}", f"usr/lib/{triplet}"]
        self.places = [(base, base / folder) for base in dict.fromkeys((root, HOST)) for folder in system]
        self.places += [(HOST, folder) for folder in folders]
        self.roots = list(dict.fromkeys((root, HOST)))

    def of(self, program):
        """Returns what a program needs as pairs: the path in the guest if its root were /, and the file."""
        seen = {}
        self.collect(program, seen)
        return list(seen.items())

    def collect(self, program, seen):
        if not self.is_elf(program):
            return
        said = subprocess.run(["readelf", "-ld", program], capture_output=True, text=True, check=True).stdout
        for name in INTERPRETER.findall(said) + NEEDED.findall(said):
            place, path = self.find(name, program)
            if place not in seen:
                seen[place] = path
                self.collect(path, seen)

    def find(self, name, program):
        candidates = [(root, root / name.lstrip("/")) for root in self.roots] if name.startswith("/") else \
            [(root, folder / name) for root, folder in self.places]
        for root, path in candidates:
            if os.path.exists(path):
                return pathlib.Path("/", path.relative_to(root)), path
        raise ValueError(f"{program} needs {name}, which is not installed for {self.architecture}")

    def is_elf(self, program):
        """Returns false for a script or data; refuses a program of another architecture."""
        with open(program, "rb") as file:
            head = file.read(20)
        if head[:4] != b"\x7fELF":
            return False
        if struct.unpack_from("<H", head, 18)[0] != ELF_MACHINES[self.architecture]:
            raise ValueError(f"{program} is not compiled for {self.architecture}, as this machine is")
        return True
