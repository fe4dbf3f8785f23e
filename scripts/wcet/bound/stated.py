"""What states the bound of a loop of the image: the LoopBound of a loop of our sources, or a fact.

The branches of the loop say which loop of the source it is, by their lines.
"""

from wcet.bound.image import Unbounded, source_line
from wcet.bound.source_loops import Loop

REMEDY = "count it by a constant step to a constant end, or give it a LoopBound"


class Stated:
    def __init__(self, image, sources, facts):
        self.image, self.sources, self.facts = image, sources, facts

    def groups(self, graph, loops, counted):
        """Returns the loops with a stated bound; nested loops that GCC made from one source loop form one group. `counted`
        says how often those with a counter go back."""
        groups = []
        for loop in loops:
            instance, most = self._of(graph, loops, loop, counted.get(loop))
            if instance is None:
                continue
            loop.tests = self._tests(graph, loop, instance)
            outer = next((g for g in groups if g[0] == instance and loop.blocks < g[1][0].blocks), None)
            if outer:
                outer[1].append(loop)
            else:
                groups.append((instance, [loop], most))
        return [(group, most) for _, group, most in groups]

    def _tests(self, graph, loop, instance):
        """The blocks that leave the loop on a line of its header."""
        source, around = instance[0], instance[1:]
        tested = lambda chain: any(
            file == source.file and source.first <= line <= source.last and tuple(chain[k + 1 :]) == around
            for k, (file, line) in enumerate(chain)
        )
        return {b for b in loop.leaving if isinstance(source, Loop) and tested(self.image.places(graph.blocks[b].last))}

    def _of(self, graph, loops, loop, counted):
        """Returns what states the bound, with the calls it was inlined into, and the bound; None, None if nothing does and
        nothing needs to. The branches back tell; if they do not, those that leave the loop do. All must tell the same. A
        fact is needed only if it says less than the counter."""
        inner = set().union(*(each.blocks for each in loops if each.blocks < loop.blocks))
        for heads in (loop.back, sorted(loop.leaving - inner), sorted(loop.leaving)):
            found = dict(filter(None, (self._told(graph, graph.blocks[head].last) for head in heads)))
            if len(found) == 1:
                instance, fact = found.popitem()
                if fact and (counted is None or self.facts.number(fact[3]) <= counted):
                    self.facts.use(fact)
                    return instance, self.facts.number(fact[3])
                if counted is not None and (fact or ".tick()" not in instance[0].body):
                    return None, None
                return instance, self._read(graph, loop, instance[0])
            if found and counted is None:
                lines = " and ".join(sorted(self._place(instance[0]) for instance in found))
                raise Unbounded(f"{graph.function}: a loop that several loops of the source end: {lines}; {REMEDY}")
        if counted is not None:
            return None, None
        ends = [graph.blocks[b].last for b in loop.back[:1] + sorted(loop.leaving)[:1]]
        where = " or ".join(dict.fromkeys(map(self.image.place, ends)))
        raise Unbounded(f"{graph.function}: a loop without a bound at {where}; {REMEDY}")

    def _told(self, graph, address):
        """Returns the loop of the source to whose header a branch belongs, with the calls it was inlined into, and a fact
        about it, or None. A loop of a library that is called in a header is another loop."""
        chain = self.image.places(address)
        for depth, (file, line) in enumerate(chain):
            fact = self.facts.loop(graph.function, file, line, source_line(file, line))
            source = self.sources.at(file, line) if all(not inner.startswith("/") for inner, _ in chain[:depth]) else None
            if fact or source:
                return (source or (file, line), *chain[depth + 1 :]), fact
        return None

    def _read(self, graph, loop, source):
        try:
            return self.sources.bound(source)
        except Unbounded as error:
            place = self.image.place(graph.blocks[loop.back[0]].last)
            raise Unbounded(f"{graph.function}: {error}, at {place}; {REMEDY}") from None

    def _place(self, source):
        return f"{source.file}:{source.first}" if isinstance(source, Loop) else f"{source[0]}:{source[1]}"
