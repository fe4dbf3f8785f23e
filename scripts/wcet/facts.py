"""What the analysis is told because neither the image nor the source of ours says it.

One fact a line; two spaces or more stand between words, # begins a comment. FUNCTION and CALLEE are regular
expressions on the written name, PLACE is the end of a file's path and a line, TEXT a regular expression on the source
line.

    loop     FUNCTION  PLACE   N        a loop of a library, by its place, or of ours, by its TEXT: its body runs at
                                        most N times each time it is entered
    size     FUNCTION  REGISTER  N      its loops run as often as the register says at the call, at most N times
    words    FUNCTION  REGISTER  N      the same, a word at a time where the register holds a multiple of four
    calls    FUNCTION  CALLEE  N        calls at most N times, each time it is called itself
    reaches  FUNCTION  CALLEE  INNER  N   of its calls of CALLEE, at most N get to INNER, each time it is called itself
    total    FUNCTION  CALLEE  N        the one loop of CALLEE, which only FUNCTION gets to, runs at most N times in all
                                        each time FUNCTION is called
    targets  FUNCTION  TEXT    CALLEE   what a call through a pointer may reach; "none": it is never made
    assume   FUNCTION  N       WHY      takes N instructions, not looked into
"""

import re

from wcet.image import Unbounded

KINDS = {"loop": 3, "size": 3, "words": 3, "calls": 3, "reaches": 4, "total": 3, "targets": 3, "assume": 3}


class Facts:
    """`values` are the numbers that facts may name, such as kDof."""

    def __init__(self, path, values):
        self.values, self.facts, self.used = values, [], set()
        for number, line in enumerate(open(path, encoding="utf-8"), 1):
            words = re.split(r"\s{2,}", line.split("#")[0].strip())
            if words != [""]:
                if KINDS.get(words[0]) != len(words) - 1:
                    raise Unbounded(f"{path}:{number}: not a fact: {line.strip()}")
                self.facts.append(tuple(words))

    def add(self, *words):
        self.facts.append(words)

    def _of(self, kind, function):
        for words in self.facts:
            if words[0] == kind and re.search(words[1], function.written):
                self.used.add(words)
                yield words[2:]

    def number(self, text):
        if text in self.values:
            return self.values[text]
        if not re.fullmatch(r"\d+", str(text)):
            raise Unbounded(f"{text} is neither a number nor a constant of the board")
        return int(text)

    def loop(self, function, file, line, text):
        """The bound of the loop whose header stands here; None if nothing is said."""
        for where, bound in self._of("loop", function):
            if f"/{file}:{line}".endswith("/" + where) or re.search(where, text):
                return self.number(bound)
        return None

    def size(self, function):
        """(register, largest value, bytes at a time) of a function whose loops an argument bounds, or None."""
        known = [(r, self.number(n), step) for kind, step in (("words", 4), ("size", 1)) for r, n in self._of(kind, function)]
        return known[0] if known else None

    def calls(self, function):
        return [(callee, self.number(most)) for callee, most in self._of("calls", function)]

    def reaches(self, function):
        return [(callee, inner, self.number(most)) for callee, inner, most in self._of("reaches", function)]

    def totals(self, function):
        """(callee, N) of loops that are counted over a whole call of this function."""
        return [(callee, self.number(most)) for callee, most in self._of("total", function)]

    def counted_above(self, function):
        """True if the runs of this function's loop are counted over a call of another."""
        return any(words[0] == "total" and re.search(words[2], function.written) for words in self.facts)

    def targets(self, function, text):
        """Patterns of what a call through a pointer may reach; None if nothing is said."""
        found = [callee for pattern, callee in self._of("targets", function) if re.search(pattern, text)]
        return found or None

    def assumed(self, function):
        return next((self.number(cost) for cost, _ in self._of("assume", function)), None)
