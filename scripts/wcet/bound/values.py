"""What the integers of a function hold where each of its blocks begins, on all paths that lead there.

A value is a base and an offset, as in walk.py. A value that no base describes gets a base of its own, named by the place
that makes it: ("v", address, register) of an instruction, ("phi", head, name) of a block to which paths bring different
values, or of a loop that changes it. So two values with one base differ by a constant in every run.
"""

from wcet.bound import walk

CORE = [*(f"r{n}" for n in range(9)), "sb", "sl", "fp", "ip", "lr"]
LOST_IN_CALLS = ("r0", "r1", "r2", "r3", "ip", "lr")
COMPARED = "compared"  # name of the two values last compared
OPPOSITE = {"eq": "ne", "lt": "ge", "gt": "le", "hi": "ls", "lo": "hs", "mi": "pl"}
OPPOSITE |= {b: a for a, b in OPPOSITE.items()}


class Values:
    """`at` holds the values at the first instruction of each block by its address, `end` those behind its last."""

    def __init__(self, graph, loops):
        self.graph = graph
        self._order = order(graph)
        self._index = {head: n for n, head in enumerate(self._order)}
        self._blocks = {loop.head: loop.blocks for loop in loops}
        self._changed = {loop.head: set() for loop in loops}
        while self._pass():
            pass

    def _pass(self):
        """Follows all paths once, loops not repeated; returns True if a loop changes more than was known."""
        self.at, self.end = {}, {}
        for head in self._order:
            self.at[head] = self._joined(head)
            self.end[head] = self._after(self.graph.blocks[head], self.at[head])
        more = False
        for head, changed in self._changed.items():
            for back in (p for p in self.graph.before[head] if not self._forward(p, head)):
                now = {n for n, value in self.at[head].items() if self.end[back].get(n) != value} - changed
                more = more or bool(now)
                changed |= now
        return more

    def _forward(self, before, head):
        return before in self._index and self._index[before] < self._index[head]

    def _joined(self, head):
        states = [self.along(p, head) for p in self.graph.before[head] if self._forward(p, head)]
        states += [dict(walk.start().values)] if head == self.graph.function.begin else []
        joined = {}
        for name in set.intersection(*map(set, states)) - {COMPARED}:
            values = {state[name] for state in states}
            new = len(values) > 1 or name in self._changed.get(head, ())
            joined[name] = (("phi", head, name), 0) if new else values.pop()
        for name in set(CORE) - set(joined):
            joined[name] = (("phi", head, name), 0)
        return joined

    def branch(self, head, successor):
        """Returns (condition, value, value) that hold where a block goes on to one of its two successors, None if unknown."""
        block, values = self.graph.blocks[head], self.end[head]
        last, compared = block.instructions[-1], values.get(COMPARED)
        name = last.mnemonic.split(".")[0]
        if name in ("cbz", "cbnz"):
            compared, taken = (values.get(last.op_str.split(",")[0]), (None, 0)), "eq" if name == "cbz" else "ne"
        else:
            taken = walk.condition_of(last) if name.startswith("b") else None
        if len(block.successors) != 2 or compared is None or None in compared or taken not in OPPOSITE:
            return None
        return taken if last.operands[-1].imm == successor else OPPOSITE[taken], *compared

    def along(self, before, head):
        """Returns the values on the edge between two blocks. On an edge out of a loop, a counter that has met its limit is
        the limit."""
        values, branch = self.end[before], self.branch(before, head)
        if branch is None or branch[0] != "eq":
            return values
        left = [h for h, blocks in self._blocks.items() if before in blocks and head not in blocks]
        counts = lambda base: isinstance(base, tuple) and base[0] == "phi" and base[1] in left
        (old, a), (new, b) = branch[1:] if counts(branch[1][0]) else branch[:0:-1]
        if not counts(old) or counts(new):
            return values
        return {n: (new, (v[1] - a + b) & walk.MASK) if n != COMPARED and v[0] == old else v for n, v in values.items()}

    def _after(self, block, values):
        machine, compared = walk.Machine(values), None
        for i in block.instructions:
            compared = self.step(machine, i, compared)
        return machine.values | ({COMPARED: compared} if compared else {})

    def ways(self, value):
        """Returns the values that a value may be, by the way that leads to where it was joined; itself if it was not."""
        base, offset = value
        if not (isinstance(base, tuple) and base[0] == "phi") or base[2] in self._changed.get(base[1], ()):
            return {value}
        joined = [self.along(p, base[1]).get(base[2]) for p in self.graph.before[base[1]] if self._forward(p, base[1])]
        if None in joined or not joined or base[1] == self.graph.function.begin:
            return {value}
        return {way for each in joined for way in self.ways((each[0], each[1] + offset))}

    def before(self, block, instruction):
        """Returns the values at an instruction of a block, by register."""
        machine, compared = walk.Machine(self.at[block.instructions[0].address]), None
        for i in block.instructions[: block.instructions.index(instruction)]:
            compared = self.step(machine, i, compared)
        return machine.values

    def step(self, machine, i, compared):
        """Carries out one instruction; returns the two values that the flags compare, or None."""
        if i.address in self.graph.calls:
            for name in LOST_IN_CALLS:
                machine.put(name, (("v", i.address, name), 0))
            machine.forget_words()
            return None
        name, words = i.mnemonic.split(".")[0], [word.strip() for word in i.op_str.split(",")]
        if name in ("cmp", "subs") and len(words) <= 3 and not any(" " in w for w in words[1:]):
            compared = machine.get(words[-2]), machine.get(words[-1])
            compared = None if None in compared else compared
        elif i.update_flags or name.startswith(("vmrs", "tst", "teq", "cmn", "cmp")):
            compared = None
        walk.execute(machine, i)
        for register in map(i.reg_name, i.regs_access()[1]):
            if register in CORE and register not in machine.values:
                machine.values[register] = (("v", i.address, register), 0)
        return compared


def order(graph):
    """Returns the heads of the blocks, each behind all that lead to it, but for ways back in loops."""
    finished, work = [], [(graph.function.begin, iter(graph.blocks[graph.function.begin].successors))]
    seen = {graph.function.begin}
    while work:
        head, rest = work[-1]
        following = next((s for s in rest if s not in seen), None)
        if following is None:
            finished.append(head)
            work.pop()
        else:
            seen.add(following)
            work.append((following, iter(graph.blocks[following].successors)))
    return finished[::-1]
