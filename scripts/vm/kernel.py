"""The kernel of the virtual machine: Debian's own with PREEMPT_RT, downloaded once and never installed."""

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

NEWEST = "linux-image-rt-amd64"  # depends on the package of the newest kernel
# What is loaded: always, with emulated controllers, and only after the command, to bring out its results.
MODULES = {
    "bus": ["can-raw", "can-bcm", "can-gw", "vcan", "vxcan"],
    "controllers": ["kvaser_pci"],
    "results": ["virtio_pci", "virtio_console"],
}
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


def package():
    """Returns the name of the package with the newest kernel; asks the mirror if the lists are not there."""
    for attempt in range(2):
        with contextlib.suppress(Missing):
            depends = told("apt-cache", "depends", NEWEST).decode()
            if found := re.search(r"Depends: (linux-image-\d[^ :\n]*)", depends):
                return found[1]
        if not attempt and os.geteuid() == 0:
            told("apt-get", "update", *HOW)
    raise Missing(f"apt-cache knows no {NEWEST}; as root: apt-get update")


def download(folder):
    """Downloads the package into the folder and returns its file."""
    try:
        told("apt-get", "download", *HOW, package(), cwd=folder)
    except Missing:
        if os.geteuid():
            raise
        told("apt-get", "update", *HOW)  # an old kernel vanishes from the mirror once there is a newer one
        told("apt-get", "download", *HOW, package(), cwd=folder)
    return next(folder.glob("linux-image-*.deb"))


def unpacked(image):
    """Returns the ELF file inside a bzImage, so that the guest need not unpack it, which takes it seconds."""
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
            shown = told("/sbin/modprobe", "-d", str(tree), "-S", version, "--show-depends", name).decode()
            for path in re.findall(r"^insmod (\S+)", shown, re.MULTILINE):
                if path not in seen:
                    shutil.copyfile(path, to / group / f"{len(seen):02}-{pathlib.Path(path).name}")
                    seen.add(path)


def fetch(cache):
    """Returns the folder with the files version, vmlinux and, per group of MODULES, a folder with its modules."""
    kernel = cache / "kernel"
    with locked(cache):
        if kernel.is_dir():
            return kernel
        with tempfile.TemporaryDirectory(dir=cache) as name:
            work = pathlib.Path(name)
            archive = download(work)
            tree, ready = work / "tree", work / "kernel"
            ready.mkdir()
            told("dpkg-deb", "-x", str(archive), str(tree))
            version = next((tree / "lib/modules").iterdir()).name
            (ready / "vmlinux").write_bytes(unpacked((tree / f"boot/vmlinuz-{version}").read_bytes()))
            collect_modules(tree, version, ready)
            (ready / "version").write_text(version + "\n")
            ready.rename(kernel)
    return kernel
