"""Names of the kernel's classes: of blocks by their type in a pipeline file, and as the source writes them."""

import pathlib
import re

KERNEL = pathlib.Path(__file__).resolve().parents[2] / "kernel"
TYPE = re.compile(r'(?:class|struct)\s+(\w+)[^{;]*\{[^}]*?kType\s*=\s*"(\w+)"', re.DOTALL)


def kinds():
    table = {}
    for file in sorted(KERNEL.rglob("*.hpp")):
        for name, word in TYPE.findall(file.read_text(encoding="utf-8")):
            table[word] = name
    return table


def as_written(names):
    """Returns demangled names with the namespace as the source writes it: without robot and switches."""
    return re.sub(r"\btactus_\w+::", "tactus::", names)
