"""The initial file system of the virtual machine: an archive whose bytes depend only on its files' names and bytes."""

import os
import pathlib
import re
import shlex
import stat

from vm import tools

HOME = "/tactus"  # the project in the guest: a fixed place, so that every checkout gives the same bytes
INIT = pathlib.Path(__file__).with_name("init")
FOLDERS = ["bin", "dev", "out", "proc", "sys", "tmp"]
DATA = ["pipelines", "build/trajectories"]
WORD = re.compile(r"[\w./+-]+")


class Image:
    """Files and links by their path in the guest."""

    def __init__(self, project, libraries):
        self.project = project
        self.libraries = libraries
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

    def copy(self, path, to=None):
        """Adds a file of the host with the libraries that it needs, at its place or to another, or a folder's files."""
        if path.is_dir():
            for each in sorted(path.rglob("*")):
                if each.is_file():
                    self.copy(each)
            return
        for place, file in [(to or path, path), *self.libraries.of(path)]:
            self.put(self.place(place), file.read_bytes(), os.access(file, os.X_OK))

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


def build(project, machine, kernel, root, script, files, groups):
    """Returns the archive: the tools below root, modules of the groups, the files, and the script that the guest runs."""
    image = Image(project, tools.Libraries(machine.architecture, root, [project / "build"]))
    for name in tools.NAMES:
        path = tools.found(name, root)
        image.copy(path, pathlib.Path("/bin", name))
        if name == "busybox" and image.libraries.of(path):
            raise tools.Missing(f"{path} is not static; as root: scripts/setup vm")
    image.link("bin/sh", "dash")  # busybox' own shell prefers its applets to programs, such as its ip
    for group in [*groups, machine.results_modules]:
        for module in sorted((kernel / group).iterdir()):
            image.put(f"modules/{group}/{module.name}", module.read_bytes())
    for path in files + [project / name for name in DATA if (project / name).is_dir()]:
        image.copy(path)
    said = {"output": machine.output, "clock": machine.clock, "groups": " ".join(groups),
            "results": machine.results, "results_modules": machine.results_modules}  # fmt: skip
    image.put("machine", "".join(f"{name}={shlex.quote(value)}\n" for name, value in said.items()).encode())
    image.put("command", script.encode())
    image.put("init", INIT.read_bytes(), executable=True)
    return image.bytes()
