"""The initial file system of the virtual machine: an archive whose bytes depend only on its files' names and bytes."""

import os
import pathlib
import re
import shutil
import stat
import subprocess

from vm.kernel import Missing

HOME = "/tactus"  # the project in the guest: a fixed place, so that every checkout gives the same bytes
INIT = pathlib.Path(__file__).with_name("init")
FOLDERS = ["bin", "dev", "out", "proc", "sys", "tmp"]
TOOLS = ["ip", "chrt", "candump", "cansend", "cangen", "canplayer"]
DATA = ["pipelines", "build/trajectories"]
WORD = re.compile(r"[\w./+-]+")


def found(tool):
    """Returns the path of a program of the host."""
    path = shutil.which(tool, path="/bin:/usr/bin:/sbin:/usr/sbin")
    if not path:
        raise Missing(f"{tool} is not installed; as root: scripts/setup vm")
    return pathlib.Path(path).resolve()


def libraries(program):
    """Returns the shared libraries that a program needs, none for a static one or a script."""
    with open(program, "rb") as file:
        if file.read(4) != b"\x7fELF":
            return []
    said = subprocess.run(["ldd", program], capture_output=True, text=True).stdout
    if absent := re.findall(r"(\S+) => not found", said):
        raise ValueError(f"{program} needs {', '.join(absent)}, which are not installed")
    return [pathlib.Path(path) for path in re.findall(r"(?:=>|^)\s*(/\S+) \(", said, re.MULTILINE)]


class Image:
    """Files and links by their path in the guest."""

    def __init__(self, project):
        self.project = project
        self.entries = {folder: (stat.S_IFDIR | 0o755, b"") for folder in FOLDERS}

    def put(self, path, data, executable=False):
        """Adds a file, and the folders in which it is."""
        for parent in list(pathlib.PurePath(path).parents)[:-1]:
            self.entries[str(parent)] = (stat.S_IFDIR | 0o755, b"")
        self.entries[path] = (stat.S_IFREG | (0o755 if executable else 0o644), data)

    def link(self, path, target):
        """Adds a symbolic link."""
        self.entries[path] = (stat.S_IFLNK | 0o777, target.encode())

    def place(self, path):
        """Returns the path in the guest of a file of the host: the project's are below HOME, others where they are."""
        path = pathlib.Path(os.path.abspath(path))
        inside = path.is_relative_to(self.project)
        return str(pathlib.Path(HOME, path.relative_to(self.project)) if inside else path).lstrip("/")

    def copy(self, path):
        """Adds a file of the host with the libraries that it needs, or all files of a folder."""
        if path.is_dir():
            for each in sorted(path.rglob("*")):
                if each.is_file():
                    self.copy(each)
            return
        for file in [path, *libraries(path)]:
            self.put(self.place(file), file.read_bytes(), os.access(file, os.X_OK))

    def bytes(self):
        """Returns the archive, a cpio of the kind that the kernel reads."""
        parts = []
        for number, (path, (mode, data)) in enumerate(sorted(self.entries.items()), 1):
            parts.append(entry(number, path, mode, data))
        return b"".join(parts) + entry(0, "TRAILER!!!", 0, b"")


def entry(number, path, mode, data):
    """Returns one entry of a cpio archive: owner root, time 0."""
    name = path.encode() + b"\0"
    fields = (number, mode, 0, 0, 1, 0, len(data), 0, 0, 0, 0, len(name), 0)
    head = b"070701" + b"".join(b"%08X" % field for field in fields) + name
    return head + b"\0" * (-len(head) % 4) + data + b"\0" * (-len(data) % 4)


def named(command, project):
    """Returns the files of the project that a command names."""
    words = {word for argument in command for word in WORD.findall(argument)}
    return sorted(path for word in words if (path := project / word).is_file() and path.is_relative_to(project))


def build(project, kernel, script, files, groups):
    """Returns the archive: busybox, tools, modules of the groups, the files, and the script that the guest runs."""
    image = Image(project)
    busybox = found("busybox")
    if libraries(busybox):
        raise Missing(f"{busybox} is not static; as root: scripts/setup vm")
    image.put("bin/busybox", busybox.read_bytes(), executable=True)
    for applet in subprocess.run([busybox, "--list"], capture_output=True, text=True, check=True).stdout.split():
        if applet != "busybox":
            image.link(f"bin/{applet}", "busybox")
    image.copy(found("dash"))  # busybox' own shell prefers its applets to programs, such as its ip
    image.link("bin/sh", "/" + image.place(found("dash")))
    for tool in TOOLS:
        image.copy(found(tool))
    for group in groups:
        for module in sorted((kernel / group).iterdir()):
            image.put(f"modules/{group}/{module.name}", module.read_bytes())
    for path in files + [project / name for name in DATA if (project / name).is_dir()]:
        image.copy(path)
    image.put("command", script.encode())
    image.put("init", INIT.read_bytes(), executable=True)
    return image.bytes()
