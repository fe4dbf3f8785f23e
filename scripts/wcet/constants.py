"""The constant that a register holds at a place of a graph, found by walking back to where it was written."""

import re

from capstone.arm import ARM_OP_IMM, ARM_OP_REG

MOVE = re.compile(r"movs?(\.w)?$|movw$")
LOST_IN_CALLS = {"r0", "r1", "r2", "r3", "ip", "lr"}
MULTIPLE = re.compile(r"pop|ldm|ldrd|umull|smull|umlal|smlal")


def at(graph, block, address, register):
    """None if it is no constant, or not the same one on all ways."""
    found = set()
    work, seen = [(block, address, register)], set()
    while work:
        here, before, name = work.pop()
        written = _written(graph, here, before, name)
        if written is None:  # not in this block: in all that lead here
            head = here.instructions[0].address
            if head == graph.function.begin or not graph.before[head]:
                return None
            for p in graph.before[head]:
                if (p, name) not in seen:
                    seen.add((p, name))
                    work.append((graph.blocks[p], None, name))
        elif isinstance(written, str):  # copied from another register
            copied, where = written.split("@")
            work.append((here, int(where), copied))
        elif written is False:
            return None
        else:
            found.add(written[0])
    return found.pop() if len(found) == 1 else None


def _written(graph, block, before, name):
    """(constant,) or "register@address" of the last write; False if it is neither, None if there is none."""
    for i in reversed(block.instructions):
        if before is not None and i.address >= before:
            continue
        if i.address in graph.calls and name in LOST_IN_CALLS:
            return False
        operands = [o.strip(" {}") for o in i.op_str.split(",")]
        if i.mnemonic.startswith(("str", "cmp", "push", "b", "cb", "tb", "v", "it", "tst")):
            continue
        if MULTIPLE.match(i.mnemonic) and name in operands:
            return False
        if operands[0] == name:
            if not MOVE.match(i.mnemonic):
                return False
            source = i.operands[1]
            if source.type == ARM_OP_IMM:
                return (source.imm,)
            return f"{operands[1]}@{i.address}" if source.type == ARM_OP_REG else False
    return None
