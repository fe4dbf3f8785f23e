"""The longest path through a function, found by executing its integer instructions.

Registers and spilled words hold constants, addresses relative to an argument or to the stack, or are unknown. A branch
on known values goes one way, any other goes both. Equal states at the same place are merged, and the longest path to
them counts. So loops with counters run exactly as often as in reality, triangular nests included, and branches on data
take the worst case. A state that leads back to itself has no counter, and there is no result.
"""

import re

from capstone.arm import ARM_CC_AL, ARM_CC_INVALID

MOST_STATES = 1000
MASK = 0xFFFFFFFF
TESTS = {
    "eq": lambda s, u: s[0] == s[1], "ne": lambda s, u: s[0] != s[1], "lt": lambda s, u: s[0] < s[1],
    "ge": lambda s, u: s[0] >= s[1], "gt": lambda s, u: s[0] > s[1], "le": lambda s, u: s[0] <= s[1],
    "hi": lambda s, u: u[0] > u[1], "ls": lambda s, u: u[0] <= u[1], "hs": lambda s, u: u[0] >= u[1],
    "lo": lambda s, u: u[0] < u[1],
}
CONDITIONS = [None, "eq", "ne", "hs", "lo", "mi", "pl", "vs", "vc", "hi", "ls", "ge", "lt", "gt", "le"]


class Machine:
    """A state: `values` by register, or by ("sp", offset) of a spilled word; `flags`: the two numbers last compared."""

    def __init__(self, values, flags=None):
        self.values, self.flags = dict(values), flags

    def key(self):
        return frozenset(self.values.items()), self.flags

    def get(self, name):
        """Returns (base, offset) of a register or #constant, None if unknown; a constant has no base."""
        if name.startswith("#"):
            return None, int(name[1:], 0)
        return self.values.get(name)

    def put(self, name, value):
        if value is None:
            self.values.pop(name, None)
        else:
            self.values[name] = (value[0], value[1] & MASK)

    def forget_words(self):
        for name in [n for n in self.values if isinstance(n, tuple)]:
            del self.values[name]

    def holds(self, condition):
        """Returns True or False, or None if the condition depends on data."""
        if self.flags is None or condition not in TESTS:
            return None
        signed = [v - (1 << 32) if v >> 31 else v for v in self.flags]
        return TESTS[condition](signed, self.flags)


def condition_of(i):
    return None if i.cc in (ARM_CC_AL, ARM_CC_INVALID) else CONDITIONS[i.cc]


def add(a, b, sign=1):
    """Adds or subtracts two values; two addresses only if they are subtracted and have the same base."""
    if a is None or b is None:
        return None
    if b[0] is None:
        return a[0], a[1] + sign * b[1]
    if sign < 0 and a[0] == b[0]:
        return None, a[1] - b[1]
    return (b[0], a[1] + b[1]) if sign > 0 and a[0] is None else None


def execute(machine, i):
    """Executes one instruction that neither branches nor calls."""
    condition = condition_of(i)
    name = re.sub(r"\.\w+$", "", i.mnemonic)
    if condition:
        name = name[: -len(condition)] if name.endswith(condition) else name
        holds = machine.holds(condition)
        if holds is False:
            return
        if holds is None:  # it may or may not execute, so the registers it writes are unknown
            return _forget(machine, i)
    operands = [o.strip() for o in re.split(r",\s*(?![^\[{]*[\]}])", i.op_str)]
    if name in ("ldr", "str", "ldrd", "strd", "vstr", "vldr", "push", "pop", "vpush", "vpop") or name.startswith(("stm", "ldm", "vstm", "vldm", "str", "ldr")):
        return _memory(machine, i, name, operands)
    if name in ("cmp", "add", "adds", "addw", "sub", "subs", "subw", "mov", "movs", "movw", "lsl", "lsls"):
        return _compute(machine, i, name, operands)
    _forget(machine, i)


def _compute(machine, i, name, operands):
    if len(operands) == 4 or operands[-1].startswith(("lsr", "asr", "ror", "rrx")):
        shift = re.fullmatch(r"lsl #(\w+)", operands.pop())
        last = machine.get(operands[-1])
        last = (None, last[1] << int(shift[1], 0)) if shift and last and last[0] is None else None
    elif operands[-1].startswith("lsl"):
        shift, last = operands.pop(), machine.get(operands[-1])
        last = (None, last[1] << int(shift[5:], 0)) if last and last[0] is None and shift[4] == "#" else None
    else:
        last = machine.get(operands[-1])
    first = machine.get(operands[-2]) if len(operands) > 1 else None
    if name in ("cmp", "subs"):
        same = first and last and first[0] == last[0]
        machine.flags = (first[1] & MASK, last[1] & MASK) if same else None
    elif i.update_flags:
        machine.flags = None
    if name == "cmp":
        return
    if name.startswith("mov"):
        value = last
    elif name.startswith("lsl"):
        known = first and last and first[0] is None and last[0] is None
        value = (None, first[1] << last[1] if last[1] < 32 else 0) if known and last[1] < 256 else None
    else:
        value = add(first, last, -1 if name.startswith("sub") else 1)
    machine.put(operands[0], value)


def _memory(machine, i, name, operands):
    """Executes a load or store. Words spilled to the stack are known; a store to an unknown address may hit any."""
    word = re.fullmatch(r"\[(\w+)(?:, #(-?\w+))?\]", operands[-1])
    base = machine.get(word[1]) if word else None
    where = ("sp", (base[1] + int(word[2] or "0", 0)) & MASK) if base and base[0] == "sp" else None
    if name == "str" and where and len(operands) == 2:
        return machine.put(where, machine.get(operands[0]))
    if name == "ldr" and where and len(operands) == 2:
        return machine.put(operands[0], machine.values.get(where))
    if name == "strd" and where:
        machine.put(where, machine.get(operands[0]))
        return machine.put((where[0], (where[1] + 4) & MASK), machine.get(operands[1]))
    if name == "ldrd" and where:
        machine.put(operands[0], machine.values.get(where))
        return machine.put(operands[1], machine.values.get((where[0], (where[1] + 4) & MASK)))
    if name.startswith(("str", "stm", "vst", "push", "vpush")):
        if where:  # of any width: eight words are enough for each
            for offset in range(-4, 8):
                machine.put((where[0], (where[1] + offset) & MASK), None)
        elif not (base and str(base[0]).startswith("argument")):
            machine.forget_words()
    moved = _moved(machine, i, name)
    _forget(machine, i)
    machine.put(*moved)


def _moved(machine, i, name):
    """The base register of an access that moves it, and where to; no register for any other access."""
    size = 8 if name[0] == "v" and "d" in i.op_str else 4
    if name.endswith(("push", "pop")):
        return "sp", add(machine.get("sp"), (None, size * len(i.operands)), -1 if "push" in name else 1)
    if behind := re.search(r"\[(\w+)(?:\], #(-?\w+)$|, #(-?\w+)\]!$)", i.op_str):
        return behind[1], add(machine.get(behind[1]), (None, int(behind[2] or behind[3], 0)))
    if block := re.match(r"(\w+)!, \{", i.op_str):
        return block[1], add(machine.get(block[1]), (None, size * (len(i.operands) - 1)), -1 if name.endswith("db") else 1)
    return "", None


def _forget(machine, i):
    _, written = i.regs_access()
    for register in written:
        name = i.reg_name(register)
        machine.put(name, None)
    if i.update_flags or i.mnemonic.startswith(("vmrs", "tst", "teq", "cmn")):
        machine.flags = None


def start():
    return Machine({"sp": ("sp", 0), **{f"r{n}": (f"argument{n}", 0) for n in range(4)}})


def follow(graph, head, machine, cost_of_call):
    """Executes one block; returns ([(next head or None at the end, state)], cost of its calls)."""
    block, cost = graph.blocks[head], 0
    for i in block.instructions[:-1] if _branches(block, graph) else block.instructions:
        if i.address in graph.calls:
            cost += _call(machine, i, block, cost_of_call)
        else:
            execute(machine, i)
    last = block.instructions[-1]
    if not _branches(block, graph):
        return [(s, machine) for s in block.successors] + ([(None, machine)] if block.leaves else []), cost
    if last.address in graph.calls:
        cost += _call(machine, last, block, cost_of_call)
    return _ways(block, last, machine), cost


def _branches(block, graph):
    last = block.instructions[-1]
    return len(block.successors) + block.leaves != 1 or last.address in graph.calls or last.mnemonic.startswith(("b", "cb", "tb"))


def _call(machine, i, block, cost_of_call):
    for name in ("r0", "r1", "r2", "r3", "ip", "lr"):
        machine.put(name, None)
    machine.forget_words()
    machine.flags = None
    return cost_of_call(block, i)


def _ways(block, last, machine):
    every = [(s, machine) for s in block.successors] + ([(None, machine)] if block.leaves else [])
    name = last.mnemonic.split(".")[0]
    if name in ("cbz", "cbnz"):
        value = machine.get(last.op_str.split(",")[0])
        taken = None if value is None or value[0] is not None else (value[1] == 0) == (name == "cbz")
        target = last.operands[1].imm
    elif condition_of(last) and name.startswith("b") and last.operands and last.operands[0].type == 2:
        taken, target = machine.holds(condition_of(last)), last.operands[0].imm
    else:
        return every
    if taken is None or target not in block.successors or len(block.successors) != 2:
        return every
    other = next(s for s in block.successors if s != target)
    return [(target if taken else other, machine)]


def longest(graph, block_cost, cost_of_call, feasible):
    """Returns the cost of the longest path; None if states repeat or there are too many."""
    first = (graph.function.begin, start())
    best, done, stack, on_way, states = {}, {}, [], set(), {}

    def open_state(head, machine):
        key = (head, machine.key())
        if key not in states:
            states[key] = machine
        return key

    root = open_state(*first)
    stack.append((root, None))
    while stack:
        key, ways = stack[-1]
        if ways is None:
            if key in done:
                stack.pop()
                continue
            if key in on_way or len(states) > MOST_STATES:
                return None
            on_way.add(key)
            copy = Machine(states[key].values, states[key].flags)
            following, called = follow(graph, key[0], copy, cost_of_call)
            keys = [open_state(h, Machine(m.values, m.flags)) if h is not None else None for h, m in following]
            keys = [k for k in keys if k is None or feasible(k[0])]
            stack[-1] = (key, keys)
            best[key] = block_cost(key[0]) + called
            stack.extend((k, None) for k in keys if k is not None and k not in done)
        else:
            stack.pop()
            on_way.discard(key)
            ends = [0 if k is None else done[k] for k in ways if k is None or done[k] is not None]
            done[key] = best[key] + max(ends) if ends else None
    return done[root]
