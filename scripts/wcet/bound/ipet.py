"""The longest path through a function, by implicit path enumeration [Li and Malik 1995]: the number of runs of each block
is an integer variable, the flow into a block equals the flow out of it, loop bounds limit the runs, and the sum of all
costs is maximised.

Callees are bounded first. Code without a bound is an error that names the place.
"""

import re

from wcet.bound import counters, walk
from wcet.bound.graph import Graph
from wcet.bound.image import Unbounded, source_line
from wcet.bound.loops import loops
from wcet.bound.program import Program
from wcet.bound.stated import Stated
from wcet.bound.values import Values


WORD = 4  # bytes


def either(*patterns):
    """Returns a pattern that matches what one of these matches."""
    return "|".join(f"(?:{p})" for p in patterns if p)


class Analysis:
    """`cost` gives the cost of one instruction; `shared` are the graphs of another analysis of the same image."""

    def __init__(self, image, sources, facts, cost, shared=None):
        self.image, self.facts, self.cost = image, facts, cost
        self._stated = Stated(image, sources, facts)
        self.graphs, self._loops, self._values = shared or ({}, {}, {})
        self.bounds, self._active = {}, []
        self.loop_claims, self.sizes = {}, {}  # what claims.py lists

    def shared(self):
        return self.graphs, self._loops, self._values

    def largest(self):
        """Returns the bound of every analysed function, by its linked name."""
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

    def values(self, graph):
        begin = graph.function.begin
        if begin not in self._values:
            self._values[begin] = Values(graph, self._loops[begin])
        return self._values[begin]

    def bound(self, function, size=None, without=None):
        """Returns the largest cost of one call, callees included; `without`: functions that it does not reach."""
        if without and not self._reaches(function, without):
            without = None
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
        """Returns the longest path according to the counters of the code; None if they do not determine it."""
        def called(block, i):
            callees = self.callees(graph, i.address)
            return self._dearest(graph, callees, block, i, None) or 0

        def feasible(head):
            calls = [i.address for i in graph.blocks[head].instructions if i.address in graph.calls]
            return all(self.callees(graph, address) for address in calls)

        costs = {head: sum(map(self.cost, block.instructions)) for head, block in graph.blocks.items()}
        return walk.longest(graph, costs.get, called, feasible)

    def _reaches(self, function, pattern):
        """Returns True if the function can reach one that matches."""
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
        program, rare, sites = Program(graph), self.facts.of("reaches", function), []
        for head, block in graph.blocks.items():
            cost, feasible = sum(map(self.cost, block.instructions)), True
            for i in block.instructions:
                if i.address not in graph.calls:
                    continue
                callees = self._left(graph, i.address, without)
                limit = next((r for r in rare if any(re.search(r[2], f.written) for f in callees)), None)
                full = usual = self._dearest(graph, callees, block, i, without)
                if limit:
                    rest = either(without, limit[3])
                    usual = self._dearest(graph, self._left(graph, i.address, rest), block, i, rest)
                feasible = feasible and full is not None
                if len(callees) > 1 and not limit:
                    each = [(f, self._dearest(graph, [f], block, i, without)) for f in callees]
                    each = [(f, cost) for f, cost in each if cost is not None]
                    sites += zip(program.choice(head, [cost for _, cost in each]), [f for f, _ in each])
                    continue
                sites += [(f"x_{head:x}", f) for f in callees]
                if full != usual:
                    self.facts.use(limit)
                    program.rarely(head, (full or 0) - (usual or 0), (*limit, self.facts.number(limit[4])), always=usual is None)
                cost += usual or 0
            program.block(head, block, cost, feasible)
        loops_here = self._loops[function.begin]
        if size is not None:
            for loop in loops_here:
                program.loop([loop], size)
        elif loops_here:
            counted = counters.of(graph, self.values(graph), loops_here)
            for loop, most in counted.items():
                program.goes_back([loop], most)
            for group, most in self._stated.groups(graph, loops_here, counted):
                program.loop(group, most)
            self.loop_claims[function.begin] = program.claims
        for fact in self.facts.of("calls", function):
            called = [runs for runs, callee in sites if re.search(fact[2], callee.written)]
            program.at_most(called, self.facts.number(fact[3]))
            if called:
                self.facts.use(fact)
        longest = program.solve(function)
        if longest is not None and self._loops[function.begin] and size is None and not without and not rare:
            walked = self._walk(graph)
            longest = longest if walked is None else min(longest, walked)
        if longest is None and not without:
            raise Unbounded(f"{function}: no path leads through it")
        return longest

    def _dearest(self, graph, callees, block, call, without):
        """Returns the largest bound of the functions called here; None if all of them reach `without`."""
        bounds = [self.bound(f, self._size_at(graph, f, block, call), without) for f in callees]
        return max((b for b in bounds if b is not None), default=None)

    def _left(self, graph, address, without):
        """Returns the possible callees that do not match `without`."""
        return [f for f in self.callees(graph, address) if not (without and re.search(without, f.written))]

    def callees(self, graph, address):
        """Returns the possible callees; none if the call is never made."""
        target = graph.calls[address]
        if target is None:
            return self._pointed_to(graph, address)
        callee = self.image.function_at(target)
        if callee is None:
            raise Unbounded(f"{graph.function}: a call whose target is not a function at {self.image.place(address)}")
        return [callee]

    def _pointed_to(self, graph, address):
        patterns = self.facts.targets(graph.function, self._source_line(address))
        if patterns is None:
            raise Unbounded(f"{graph.function}: a call through a pointer without known targets at {self.image.place(address)}")
        if patterns == ["none"]:
            return []
        callees = [f for pattern in patterns for f in self.image.matching(pattern)]
        if not callees:
            raise Unbounded(f"{graph.function}: no target matches {' '.join(patterns)} at {self.image.place(address)}")
        return callees

    def _source_line(self, address):
        return next((source_line(*place) for place in self.image.places(address) if source_line(*place)), "")

    def _size_at(self, graph, callee, block, call):
        """Returns how often the loops of a copying function run in this call, by the size that a register holds."""
        register = self.facts.size(callee)
        if register is None:
            return None
        base, size = self.values(graph).before(block, call).get(register)
        if base is not None:
            place = self.image.place(call.address)
            raise Unbounded(f"{graph.function}: {callee} of an unknown size at {place}; copy objects whose size is constant")
        self.sizes[call.address] = size if size % WORD else size // WORD
        return self.sizes[call.address]
