"""The kernel of a virtual machine: Debian's own with PREEMPT_RT, downloaded once and never installed."""

import contextlib
import fcntl
import lzma
import os
import pathlib
import re
import shutil
import struct
import subprocess
import tempfile

from vm.machines import KERNELS, MACHINES, MODULES

FD = "fd"  # the group that scripts/vm/ctucanfd compiles
LONGEST_DOWNLOAD_S = 600
# As root, because apt's own user cannot write into the folder.
HOW = ["-q", "-o", "Acquire::Retries=1", "-o", "APT::Sandbox::User=root"]


class Missing(Exception):
    """The machine cannot be had here; the text says why and what helps."""


def told(*command, **options):
    """Returns the output of a command; raises Missing if it fails."""
    try:
        return subprocess.run(
            command, check=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=LONGEST_DOWNLOAD_S, **options
        ).stdout
    except OSError as error:
        raise Missing(f"{command[0]}: {error.strerror}; as root: scripts/setup vm") from None
    except subprocess.TimeoutExpired:
        raise Missing(f"{' '.join(command[:2])} took longer than {LONGEST_DOWNLOAD_S} s") from None
    except subprocess.CalledProcessError as error:
        said = error.stderr.decode(errors="replace").strip().splitlines() or [f"exit code {error.returncode}"]
        raise Missing(f"{' '.join(command[:2])}: {said[-1]}") from None


@contextlib.contextmanager
def locked(folder):
    """Lets one process at a time change the folder."""
    folder.mkdir(parents=True, exist_ok=True)
    with open(folder / "lock", "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def newest(architecture):
    """Returns the package of the newest kernel; asks the mirror if the lists are not there."""
    what = f"{KERNELS[architecture]}:{architecture}"
    for attempt in range(2):
        with contextlib.suppress(Missing):
            depends = told("apt-cache", "depends", what).decode()
            if found := re.search(r"Depends: (linux-image-\d[^ :\n]*)", depends):
                return f"{found[1]}:{architecture}"
        if not attempt and os.geteuid() == 0:
            told("apt-get", "update", *HOW)
    raise Missing(f"apt-cache knows no {what}; as root: dpkg --add-architecture {architecture}; apt-get update")


def download(folder, find):
    """Downloads the packages that find() names into the folder and unpacks them there, into tree."""
    try:
        told("apt-get", "download", *HOW, *find(), cwd=folder)
    except Missing:
        if os.geteuid():
            raise
        told("apt-get", "update", *HOW)  # an old kernel vanishes from the mirror once there is a newer one
        told("apt-get", "download", *HOW, *find(), cwd=folder)
    tree = folder / "tree"
    for archive in folder.glob("*.deb"):
        told("dpkg-deb", "-x", str(archive), str(tree))
    return tree


def unpacked(image):
    """Returns the kernel without compression, which would take the guest seconds."""
    if image[0x38:0x3C] == b"ARM\x64":
        return image
    offset, length = struct.unpack_from("<II", image, 0x248)
    begin = ((image[0x1F1] or 4) + 1) * 512 + offset
    elf = lzma.LZMADecompressor().decompress(image[begin : begin + length])
    if elf[:4] != b"\x7fELF":
        raise Missing("the kernel is not an ELF file in a bzImage")
    return elf


def collect_modules(tree, version, to):
    """Copies the modules and those that they need; their names sort in the order of loading."""
    told("/sbin/depmod", "-b", str(tree), version)
    seen = set()
    for group, names in MODULES.items():
        (to / group).mkdir()
        for name in names:
            try:
                shown = told("/sbin/modprobe", "-d", str(tree), "-S", version, "--show-depends", name).decode()
            except Missing:
                continue  # of another architecture's board; without one that it needs, a machine says what failed
            for path in re.findall(r"^insmod (\S+)", shown, re.MULTILINE):
                if path not in seen:
                    shutil.copyfile(path, to / group / f"{len(seen):02}-{pathlib.Path(path).name}")
                    seen.add(path)


def collect_trees(architecture, tree, to):
    """Copies the device trees of the machines, without what QEMU does not emulate."""
    for name, machine in MACHINES.items():
        if machine.architecture == architecture and machine.tree:
            blob = to / f"{name}.dtb"
            shutil.copyfile(next(tree.glob(f"usr/lib/linux-image-*/{machine.tree}")), blob)
            for node in machine.absent:
                told("fdtput", "-t", "s", str(blob), node, "status", "disabled")


def fetch(cache, architecture):
    """Returns the folder with the files version, vmlinux, device trees and, per group of MODULES, a folder of modules."""
    kernel = cache / architecture / "kernel"
    with locked(cache):
        if kernel.is_dir():
            return kernel
        kernel.parent.mkdir(exist_ok=True)
        with tempfile.TemporaryDirectory(dir=cache) as name:
            work = pathlib.Path(name)
            tree = download(work, lambda: [newest(architecture)])
            ready = work / "kernel"
            ready.mkdir()
            version = next((tree / "lib/modules").iterdir()).name
            (ready / "vmlinux").write_bytes(unpacked((tree / f"boot/vmlinuz-{version}").read_bytes()))
            collect_modules(tree, version, ready)
            collect_trees(architecture, tree, ready)
            (ready / "version").write_text(version + "\n")
            ready.rename(kernel)
    return kernel
