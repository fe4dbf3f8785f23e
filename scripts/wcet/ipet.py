"""The longest path through a function, by implicit path enumeration [Li and Malik 1995]: how often each block runs is an
integer, what flows into a block flows out of it, loops run as often as they may; the sum of all costs is maximised.

Callees come first. What has no bound is an error that names the place.
"""

import functools
import re

from wcet import constants, walk
from wcet.graph import Graph
from wcet.image import ROOT, Unbounded
from wcet.loops import loops
from wcet.program import Program


MANY = 10  # runs of a loop after which each further one costs the same


def either(*patterns):
    """A pattern of what one of these matches."""
    return "|".join(f"(?:{p})" for p in patterns if p)


class Analysis:
    """`cost` gives the cost of one instruction; `shared` are the graphs of another analysis of the same image."""

    def __init__(self, image, sources, facts, cost, shared=None):
        self.image, self.sources, self.facts, self.cost = image, sources, facts, cost
        self.graphs, self._loops = shared or ({}, {})
        self.bounds, self._active = {}, []

    def shared(self):
        return self.graphs, self._loops

    def largest(self):
        """The bound of every function that was looked into, by its linked name."""
        found = {}
        for begin, bound in ((key[0], bound) for key, bound in self.bounds.items() if bound is not None):
            name = self.image.function_at(begin).symbol
            found[name] = max(bound, found.get(name, 0))
        return found

    def graph(self, function):
        if function.begin not in self.graphs:
            graph = self.graphs[function.begin] = Graph(self.image, function)
            self.image.learn_places([b.last for b in graph.blocks.values()] + list(graph.calls))
            self._loops[function.begin] = loops(graph)
        return self.graphs[function.begin]

    def bound(self, function, size=None, without=None):
        """The largest cost of one call, that of its callees included; `without` is what it does not get to."""
        if without and not self._reaches(function, without):
            without = None
        if size is None and self.facts.counted_above(function):
            size = 0
        key = (function.begin, size, without)
        if key in self.bounds:
            return self.bounds[key]
        assumed = self.facts.assumed(function)
        if assumed is not None:
            self.bounds[key] = assumed * self.cost(None)
            return self.bounds[key]
        if function.begin in self._active:
            path = self._active[self._active.index(function.begin) :] + [function.begin]
            names = " > ".join(str(self.image.function_at(a)) for a in path)
            raise Unbounded(f"recursion: {names}, first at {self.image.place(function.begin)}")
        self._active.append(function.begin)
        self.bounds[key] = self._solve(function, size, without)
        self._active.pop()
        return self.bounds[key]

    def _walk(self, graph):
        """The longest way by what the code does with its counters; None if they do not say it."""
        def called(block, i):
            callees = self.callees(graph, i.address)
            return self._dearest(graph, callees, block, i, None) or 0

        def feasible(head):
            calls = [i.address for i in graph.blocks[head].instructions if i.address in graph.calls]
            return all(self.callees(graph, address) for address in calls)

        costs = {head: sum(map(self.cost, block.instructions)) for head, block in graph.blocks.items()}
        return walk.longest(graph, costs.get, called, feasible)

    def _reaches(self, function, pattern):
        """True if a function that matches can be called from here on."""
        work, seen = [function], set()
        while work:
            here = work.pop()
            if here.begin in seen or self.facts.assumed(here) is not None:
                continue
            seen.add(here.begin)
            if re.search(pattern, here.written):
                return True
            graph = self.graph(here)
            work += [callee for address in graph.calls for callee in self.callees(graph, address)]
        return False

    def _solve(self, function, size, without):
        graph = self.graph(function)
        program, rare, sites = Program(graph), self.facts.reaches(function), []
        for head, block in graph.blocks.items():
            cost, feasible = sum(map(self.cost, block.instructions)), True
            for i in block.instructions:
                if i.address not in graph.calls:
                    continue
                callees = self._left(graph, i.address, without)
                limit = next((r for r in rare if any(re.search(r[0], f.written) for f in callees)), None)
                full = usual = self._dearest(graph, callees, block, i, without)
                if limit:
                    rest = either(without, limit[1])
                    usual = self._dearest(graph, self._left(graph, i.address, rest), block, i, rest)
                feasible = feasible and full is not None
                if len(callees) > 1 and not limit:
                    each = [(f, self._dearest(graph, [f], block, i, without)) for f in callees]
                    each = [(f, cost) for f, cost in each if cost is not None]
                    sites += zip(program.choice(head, [cost for _, cost in each]), [f for f, _ in each])
                    continue
                sites += [(f"x_{head:x}", f) for f in callees]
                if full != usual:
                    program.rarely(head, (full or 0) - (usual or 0), limit, always=usual is None)
                cost += usual or 0
            program.block(head, block, cost, feasible)
        for group, most, scope in self._groups(graph, size):
            program.loop(group, most)
            if scope:
                program.sum_of_runs(group[0], most, scope)
        for pattern, most in self.facts.calls(function):
            program.at_most([runs for runs, callee in sites if re.search(pattern, callee.written)], most)
        longest = program.solve(function)
        if longest is not None and self._loops[function.begin] and size is None and not without and not rare:
            walked = self._walk(graph)
            longest = longest if walked is None else min(longest, walked)
        if longest is None and not without:
            raise Unbounded(f"{function}: no path leads through it")
        if longest is not None:
            longest += sum(most * self._of_one_run(callee) for callee, most in self.facts.totals(function))
        return longest

    def _of_one_run(self, pattern):
        """What each further run of the one loop of a function costs at most."""
        costs = []
        for callee in self.image.matching(pattern):
            self.graph(callee)
            if len(self._loops[callee.begin]) != 1:
                raise Unbounded(f"{callee}: not one loop, whose runs could be counted over several calls")
            costs.append(self.bound(callee, MANY + 1) - self.bound(callee, MANY))
        if not costs:
            raise Unbounded(f"{self.image.path}: no function matches {pattern}")
        return max(costs)

    def _dearest(self, graph, callees, block, call, without):
        """The largest bound of what is called here; None if all of it gets to `without`."""
        bounds = [self.bound(f, self._size_at(graph, f, block, call), without) for f in callees]
        return max((b for b in bounds if b is not None), default=None)

    def _left(self, graph, address, without):
        """What a call may reach but for what matches `without`."""
        return [f for f in self.callees(graph, address) if not (without and re.search(without, f.written))]

    def callees(self, graph, address):
        """What a call may reach; nothing if it is never made."""
        target = graph.calls[address]
        if target is None:
            return self._pointed_to(graph, address)
        callee = self.image.function_at(target)
        if callee is None:
            raise Unbounded(f"{graph.function}: a call of what is no function at {self.image.place(address)}")
        return [callee]

    def _pointed_to(self, graph, address):
        patterns = self.facts.targets(graph.function, self._source_line(address))
        if patterns is None:
            raise Unbounded(f"{graph.function}: a call through a pointer, without targets, at {self.image.place(address)}")
        if patterns == ["none"]:
            return []
        callees = [f for pattern in patterns for f in self.image.matching(pattern)]
        if not callees:
            raise Unbounded(f"{graph.function}: no target matches {' '.join(patterns)} at {self.image.place(address)}")
        return callees

    def _source_line(self, address):
        return next((source_line(*place) for place in self.image.places(address) if source_line(*place)), "")

    def _size_at(self, graph, callee, block, call):
        """The constant that a copying function is given in a register at this call, or the largest there is."""
        sized = self.facts.size(callee)
        if sized is None:
            return None
        register, most, step = sized
        constant = constants.at(graph, block, call.address, register)
        size = most if constant is None else min(most, constant)
        return size if constant is None or constant % step else size // step

    def _groups(self, graph, size):
        """Loops with their bounds; those nested loops in one that GCC made of one loop of the source."""
        groups = []
        for loop in self._loops[graph.function.begin]:
            instance, most = self._bound_of(graph, loop, size)
            outer = next((g for g in groups if g[0] == instance and loop.blocks < g[1][0].blocks), None)
            if outer:
                outer[1].append(loop)
            else:
                groups.append((instance, [loop], most, self._scope(instance, loop, groups)))
        return [(group, most, scope) for _, group, most, scope in groups]

    def _runs(self, graph, source, address):
        try:
            return self.sources.bound(source)
        except Unbounded as error:
            raise Unbounded(f"{graph.function}: {error}, at {self.image.place(address)}") from None

    def _scope(self, instance, loop, outer):
        """The outermost loop around, in the function that owns the LoopBound this loop was given by reference."""
        name = self.sources.shared(instance[0]) if len(instance) > 1 and hasattr(instance[0], "body") else None
        for around, parts, *_ in outer if name else []:
            owned = hasattr(around[0], "before") and re.search(rf"LoopBound<[^;>]+>\s+{name};", around[0].before)
            if owned and loop.blocks < parts[0].blocks and around[1:] == instance[2:]:
                return parts[0]
        return None

    def _bound_of(self, graph, loop, size):
        """The loop of the source that this one is, with what it was inlined into, and how often it runs."""
        if size is not None:
            return (loop.head,), size
        ways = [graph.blocks[b].last for b in loop.back] + [graph.blocks[b].last for b in sorted(loop.leaving)]
        for address in ways:
            chain = self.image.places(address)
            for depth, (file, line) in enumerate(chain):
                if (known := self.facts.loop(graph.function, file, line, source_line(file, line))) is not None:
                    return (file, line, *chain[depth + 1 :]), known
                if source := self.sources.at(file, line):
                    return (source, *chain[depth + 1 :]), self._runs(graph, source, address)
        where = " or ".join(dict.fromkeys(self.image.place(a) for a in ways[:2]))
        raise Unbounded(f"{graph.function}: a loop without a bound at {where}")


@functools.lru_cache(maxsize=None)
def source_line(file, line):
    """A line of a source of ours; nothing of others."""
    if file.startswith("/"):
        return ""
    lines = (ROOT / file).read_text(encoding="utf-8").splitlines()
    return lines[line - 1] if 0 < line <= len(lines) else ""
