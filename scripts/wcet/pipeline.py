"""What a pipeline file says of a cycle: how often each kind of block steps in it, and under which names."""

import pathlib
import re

from wcet.image import ROOT, Unbounded

TYPE = re.compile(r'(?:class|struct)\s+(\w+)[^{;]*\{[^}]*?kType\s*=\s*"(\w+)"', re.DOTALL)


def kinds():
    """The class of every kind of block by its word in a file."""
    table = {}
    for file in sorted((ROOT / "kernel").rglob("*.hpp")):
        for name, word in TYPE.findall(file.read_text(encoding="utf-8")):
            table[word] = name
    return table


def blocks(path):
    """(section, class) of every block of the file, in order."""
    found, section, table = [], None, kinds()
    for number, line in enumerate(pathlib.Path(path).read_text(encoding="utf-8").splitlines(), 1):
        line = line.split("#")[0].strip()
        if match := re.fullmatch(r"\[(\w+)\]", line):
            section = match[1]
        elif (match := re.fullmatch(r"type\s*=\s*(\w+)", line)) and section:
            if match[1] not in table:
                raise Unbounded(f"{path}:{number}: {match[1]} is no kind of block")
            found.append((section, table[match[1]]))
    return found


def tell(facts, steps):
    """Adds what the file says: as many steps as it has blocks, of each kind as many as it has."""
    facts.add("loop", r"Pipeline::step\(", r"i < count_", str(len(steps)))
    for kind in kinds().values():
        count = sum(kind == step for _, step in steps)
        facts.add("calls", r"Pipeline::step\(", rf"step_block<tactus::{kind}>", str(count))


def stages(analysis, steps):
    """The bound of every stage: of each block, of the guard, of reading and writing, and of the whole cycle."""
    def largest(pattern):
        found = analysis.image.matching(pattern)
        if not found:
            raise Unbounded(f"{analysis.image.path}: no function matches {pattern}")
        return max(analysis.bound(f) for f in found)

    found = {section: largest(rf"step_block<tactus::{kind}>") for section, kind in steps}
    found["guard"] = largest(r"^tactus::Guard::limit\(")
    found["read"] = largest(r"Hal::read\(") + largest(r"^tactus::Guard::check\(")
    found["write"] = largest(r"Hal::write\(")
    found["cycle"] = largest(r"^tactus::Executive::cycle\(")
    return found
