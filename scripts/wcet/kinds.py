"""The classes of all kinds of blocks, by their type in a pipeline file."""

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
