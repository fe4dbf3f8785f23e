"""How many joints a robot has: its table says it."""

import pathlib
import re

TABLES = pathlib.Path(__file__).resolve().parents[2] / "kernel/robots"


def count(robot):
    table = (TABLES / f"{robot}.hpp").read_text(encoding="utf-8")
    return int(re.search(r"\bint kDof = (\d+);", table)[1])
