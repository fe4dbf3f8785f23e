"""The settings of a run: its pipeline file, and for keys that are not in it the defaults of docs/ports.md."""

import functools
import pathlib
import re

from reporting.inputs import InputError, read_text

PORTS = pathlib.Path(__file__).resolve().parents[2] / "docs/ports.md"  # what `tactus ports` prints
CHAIN = {
    "joint_reference_generator": "JRG",
    "task_reference_generator": "TRG",
    "admittance": "AC",
    "cartesian_pose": "CPC",
    "pd_gravity": "PDGC",
    "pid": "PID",
}


@functools.lru_cache
def defaults():
    """Returns {(section, key): default}; the section of a block is its "type = ..."."""
    found, section = {}, ""
    for line in read_text(PORTS).splitlines():
        if line.startswith("## "):
            section = line[3:].strip("[]")
        cells = [cell.strip() for cell in line.split("|")[1:-1]]
        if len(cells) == 5 and cells[0].startswith("`"):
            found[section, cells[0].strip("`")] = cells[3]
    return found


class Settings:
    """The sections of a pipeline file."""

    def __init__(self, path):
        self.path, self.sections = path, {}
        section = {}
        for line in read_text(path).splitlines():
            line = line.split("#")[0].strip()
            if match := re.fullmatch(r"\[(.+)\]", line):
                section = self.sections.setdefault(match[1].strip(), {})
            elif "=" in line:
                key, _, value = line.partition("=")
                section[key.strip()] = value.strip()

    def blocks(self, kind):
        """Returns the names of the blocks of a type, in the order of the file."""
        return [name for name, keys in self.sections.items() if keys.get("type") == kind]

    def given(self, section, key):
        """Returns what the file says, or None."""
        return self.sections.get(section, {}).get(key)

    def value(self, section, key):
        """Returns a setting as text: that of the file, else the default."""
        given = self.given(section, key)
        if given is not None:
            return given
        kind = self.given(section, "type")
        default = defaults().get((f"type = {kind}" if kind else section, key))
        if default is None:
            raise InputError(f"{self.path}: [{section}] has no {key}, and {PORTS.name} no default")
        return default

    def numbers(self, section, key, count):
        """Returns a setting as `count` numbers; one number stands for all."""
        try:
            numbers = [float(word) for word in self.value(section, key).split()]
        except ValueError as error:
            raise InputError(f"{self.path}: [{section}] {key}: {error}") from error
        if len(numbers) not in (1, count):
            raise InputError(f"{self.path}: [{section}] {key}: {len(numbers)} numbers, expected {count}")
        return numbers * count if len(numbers) == 1 else numbers

    def number(self, section, key):
        return self.numbers(section, key, 1)[0]

    def chain(self):
        """Returns the chain in the paper's abbreviations."""
        kinds = (keys.get("type") for keys in self.sections.values())
        return " → ".join(CHAIN[kind] for kind in kinds if kind in CHAIN)
