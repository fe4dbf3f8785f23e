"""The loops of a graph: its strongly connected parts, and those that remain inside each without its head."""

from wcet.bound.image import Unbounded


class Loop:
    """A loop of the binary: its head, its blocks, and the edges that enter it, leave it and go back to its head."""

    def __init__(self, graph, head, blocks):
        self.head, self.blocks = head, blocks
        self.back = [b for b in sorted(blocks) if head in graph.blocks[b].successors]
        self.entering = [(p, head) for p in graph.before[head] if p not in blocks]
        self.leaving = {b for b in blocks if any(s not in blocks for s in graph.blocks[b].successors)}
        self.leaving |= {b for b in blocks if graph.blocks[b].leaves}
        self.tests = set()  # the leaving blocks that are known to end with the test of the loop's header

    def tested_at_end(self):
        """Returns True if the loop is tested after each run, not before: every way back may leave, and nothing else may by
        the test of the header, though the body may return."""
        return (set(self.back) >= self.leaving or set(self.back) == self.tests) and self.leaving >= set(self.back)


def loops(graph):
    """Returns all loops, outer ones first. A loop that is entered at several places has no head and is refused."""
    found = []

    def walk(nodes):
        for part in connected(graph, nodes):
            entry = graph.function.begin
            heads = sorted(b for b in part if b == entry or any(p not in part for p in graph.before[b]))
            if len(heads) > 1:
                places = ", ".join(graph.image.place(h) for h in heads)
                raise Unbounded(f"{graph.function}: a loop that is entered at several places: {places}")
            found.append(Loop(graph, heads[0], part))
            walk(part - {heads[0]})

    walk(set(graph.blocks))
    return found


def connected(graph, nodes):
    """Returns strongly connected parts of several blocks, or of one that follows itself. [Tarjan 1972, not recursive]"""
    index, low, stack, waiting, parts = {}, {}, [], set(), []
    successors = lambda node: iter([s for s in graph.blocks[node].successors if s in nodes])
    for root in sorted(nodes):
        if root in index:
            continue
        work = []

        def enter(node):
            index[node] = low[node] = len(index)
            stack.append(node)
            waiting.add(node)
            work.append((node, successors(node)))

        enter(root)
        while work:
            node, rest = work[-1]
            following = next(rest, None)
            if following is not None:
                if following not in index:
                    enter(following)
                elif following in waiting:
                    low[node] = min(low[node], index[following])
                continue
            work.pop()
            if work:
                low[work[-1][0]] = min(low[work[-1][0]], low[node])
            if low[node] == index[node]:
                part = set()
                while node not in part:
                    part.add(stack.pop())
                waiting -= part
                if len(part) > 1 or node in graph.blocks[node].successors:
                    parts.append(part)
    return parts
