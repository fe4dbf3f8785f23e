"""The integer program whose optimum is the longest path through a graph; glpsol solves it."""

import pathlib
import re
import subprocess
import tempfile

from wcet.bound.image import Unbounded


class Program:
    """The integer program of one function, in the format that glpsol reads."""

    def __init__(self, graph):
        self.graph, self.objective, self.rows, self.variables = graph, [], [], {"in"}
        self._rare, self._costs, self._plain = {}, {}, True
        self.claims = []  # (loops, how often they go back)

    def block(self, head, block, cost, feasible):
        edges_in = [f"e_{p:x}_{head:x}" for p in self.graph.before[head]] + (["in"] if head == self.graph.function.begin else [])
        edges_out = [f"e_{head:x}_{s:x}" for s in block.successors] + ([f"out_{head:x}"] if block.leaves else [])
        runs = f"x_{head:x}"
        self.variables.update([runs, *edges_in, *edges_out])
        self.rows += [f"{' + '.join(edges) or '0 in'} - {runs} = 0" for edges in (edges_in, edges_out)]
        self.objective.append(f"{cost} {runs}")
        self._costs[head] = cost if feasible else None
        if not feasible:
            self.rows.append(f"{runs} = 0")

    def rarely(self, head, more, limit, always):
        """Lets some runs of the block, or all, cost more; the limit bounds their number over all its blocks."""
        rare, self._plain = self._rare.setdefault(limit, []), False
        runs = f"y{len(rare)}_{head:x}"
        rare.append(runs)
        self.variables.add(runs)
        self.rows.append(f"{runs} - x_{head:x} {'=' if always else '<='} 0")
        self.objective.append(f"{more} {runs}")

    def choice(self, head, costs):
        """Lets each run of the block make one of these calls; returns their variables."""
        self._plain = False
        runs = [f"c{len(self.rows)}_{k}_{head:x}" for k in range(len(costs))]
        self.variables.update(runs)
        self.rows.append(f"{' + '.join(runs)} - x_{head:x} = 0")
        self.objective += [f"{cost} {each}" for cost, each in zip(costs, runs)]
        return runs

    def loop(self, group, most):
        """Bounds the runs of all loops of the group together, for each entry of the outermost."""
        often = most - 1 if len(group) == 1 and group[0].tested_at_end() else most
        self.goes_back(group, max(often, 0))

    def goes_back(self, group, often):
        """Bounds the edges back of all loops of the group, for each entry of the outermost."""
        self._plain, outer = False, group[0]
        self.claims.append((group, often))
        back = [f"e_{b:x}_{part.head:x}" for part in group for b in part.back]
        entering = [f"e_{p:x}_{s:x}" for p, s in outer.entering]
        entering += ["in"] if outer.head == self.graph.function.begin else []
        self.rows.append(" + ".join(back) + "".join(f" - {often} {e}" for e in entering) + " <= 0")

    def at_most(self, variables, most):
        if variables:
            self._plain = False
            self.rows.append(f"{' + '.join(variables)} <= {most}")

    def solve(self, function):
        """Returns the cost of the longest path; None if there is no path."""
        if self._plain:
            return self._longest_without_loops()
        for (*_, most), rare in self._rare.items():
            self.at_most(rare, most)
        with tempfile.TemporaryDirectory() as folder:
            problem, answer = pathlib.Path(folder, "problem"), pathlib.Path(folder, "answer")
            rows = "\n".join(f" r{n}: {row}" for n, row in enumerate([*self.rows, "in = 1"]))
            variables = "\n ".join(sorted(self.variables))
            problem.write_text("Maximize\n cost: " + "\n + ".join(self.objective) + f"\nSubject To\n{rows}\nGeneral\n {variables}\nEnd\n")
            run = subprocess.run(["glpsol", "--lp", problem, "-o", answer], capture_output=True, text=True)
            text = answer.read_text() if answer.exists() else ""
        if "INTEGER EMPTY" in text or "INTEGER UNDEFINED" in text or "NO PRIMAL FEASIBLE" in run.stdout:
            return None
        found = re.search(r"^Objective: +cost = ([-+.\de]+)", text, re.MULTILINE)
        if "INTEGER OPTIMAL" not in text or not found:
            raise Unbounded(f"{function}: glpsol finds no longest path\n{run.stdout}")
        return round(float(found[1]))

    def _longest_without_loops(self):
        """Solves a program without loops or other bounds block by block, successors first."""
        longest, work = {}, [self.graph.function.begin]
        while work:
            head = work[-1]
            block = self.graph.blocks[head]
            missing = [s for s in block.successors if s not in longest]
            if missing:
                work += missing
                continue
            ends = [longest[s] for s in block.successors if longest[s] is not None] + ([0] if block.leaves else [])
            cost = self._costs[work.pop()]
            longest[head] = cost + max(ends) if ends and cost is not None else None
        return longest[self.graph.function.begin]
