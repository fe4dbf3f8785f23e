"""How often a loop of the image may go back to its head, where a counter governs it.

A counter is a register or a word of the stack that every way through the loop changes by the same step. A branch on every
way compares it with something that the loop does not change, and leaves the loop. What the counter holds when the loop is
entered, the step and the comparison are read from the instructions alone, so no line of the source is believed.
"""

from wcet.bound import walk
MOST_RUNS = 1 << 16
SIGN = 1 << 31
TESTS = walk.TESTS | {
    "mi": lambda s, u: (u[0] - u[1]) & SIGN != 0, "pl": lambda s, u: (u[0] - u[1]) & SIGN == 0,
}  # fmt: skip
UPWARD, DOWNWARD = ("ne", "lt", "lo"), ("ne", "gt", "hi")
MIRRORED = {"ne": "ne", "eq": "eq", "lt": "gt", "le": "ge", "lo": "hi", "ls": "hs"}
MIRRORED |= {b: a for a, b in MIRRORED.items()}


def of(graph, values, loops):
    """Returns {loop: how often it goes back to its head for each entry} of the loops that a counter governs."""
    known = {loop: most_back(graph, values, loop) for loop in loops}
    return {loop: most for loop, most in known.items() if most is not None}


def most_back(graph, values, loop):
    """Returns how often a loop goes back to its head for each entry, None if no counter tells. Several branches may tell
    together, if every way through the loop leads through one of them."""
    told = {head: _continued(graph, values, loop, head) for head in loop.leaving}
    tests = set()
    for most, head in sorted((most, head) for head, most in told.items() if most is not None):
        tests.add(head)
        if _always(graph, loop, tests):
            return most
    return None


def _always(graph, loop, tests):
    """Returns True if every way from the loop's head back to it leads through one of these blocks."""
    work, seen = [loop.head], set(tests)
    while work:
        here = work.pop()
        if here in seen:
            continue
        if here in loop.back:
            return False
        seen.add(here)
        work += [s for s in graph.blocks[here].successors if s in loop.blocks]
    return True


def _continued(graph, values, loop, head):
    """Returns how often in a row the branch that ends a block can stay in the loop, None if that is not known."""
    inside = [s for s in graph.blocks[head].successors if s in loop.blocks]
    branch = values.branch(head, inside[0]) if len(inside) == 1 else None
    if branch is None:
        return None
    condition, *compared = branch
    runs = _runs(graph, values, loop, condition, *compared)
    return _runs(graph, values, loop, MIRRORED.get(condition), *compared[::-1]) if runs is None else runs


def _runs(graph, values, loop, condition, counter, limit):
    """Returns how often `counter CONDITION limit` holds in a row from the entry, None if that is not known."""
    base = counter[0]
    if condition is None or not (isinstance(base, tuple) and base[:2] == ("phi", loop.head)) or _changes(graph, loop, limit[0]):
        return None
    back = {values.end[b].get(base[2]) for b in loop.back}
    first = {values.along(p, loop.head).get(base[2]) for p, _ in loop.entering}
    if len(back) != 1 or None in back | first or loop.head == graph.function.begin:
        return None
    first = {way for each in first for way in values.ways(each)}
    moved = back.pop()
    step = _signed(moved[1]) if moved[0] == base else 0
    runs = [_from(f[0], f[1] + counter[1], step, condition, limit) for f in first] if step else [None]
    return None if None in runs else max(runs)


def _changes(graph, loop, base):
    """Returns True if the loop may change what a base stands for."""
    if not isinstance(base, tuple):
        return False
    return any(b in loop.blocks and (base[1] == b or graph.blocks[b].instructions[0].address <= base[1] <= graph.blocks[b].last)
               for b in loop.blocks)


def _from(base, first, step, condition, limit):
    """Returns how often the comparison holds in a row of a counter that begins at `first` from its base."""
    if base != limit[0]:
        return None
    if base is None:
        return next((k for k in range(MOST_RUNS) if not _holds(condition, first + k * step, limit[1])), None)
    # The base is not known, so the sums may overflow: only a counter that meets its limit exactly is sure to stop there.
    runs, rest = divmod(_signed(limit[1] - first), step)
    return runs if rest == 0 and runs >= 0 and condition in (UPWARD if step > 0 else DOWNWARD) else None


def _holds(condition, a, b):
    unsigned = (a & walk.MASK, b & walk.MASK)
    return TESTS[condition]([_signed(x) for x in unsigned], unsigned)


def _signed(value):
    value &= walk.MASK
    return value - (1 << 32) if value & SIGN else value
