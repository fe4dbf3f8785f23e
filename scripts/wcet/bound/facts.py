"""Facts that the analysis needs and that neither the image nor our sources contain.

A file has one fact per line; words are separated by two spaces or more, # begins a comment. FUNCTION and CALLEE are
regular expressions on the written name, PLACE is the end of a file's path and a line, TEXT a regular expression on the
source line.

    loop     FUNCTION  PLACE   N        a loop of a library, by its place, or of ours, by its TEXT: its body runs at
                                        most N times each time it is entered
    words    FUNCTION  REGISTER         copies as many bytes as the register says at the call, which must be a constant; its
                                        loops run once for each byte, or for each word if that is a multiple of four
    calls    FUNCTION  CALLEE  N        each call of FUNCTION calls CALLEE at most N times
    reaches  FUNCTION  CALLEE  INNER  N   in each call of FUNCTION, at most N of its calls of CALLEE reach INNER
    targets  FUNCTION  TEXT    CALLEE   a target of a call through a pointer; "none": the call is never made
    assume   FUNCTION  N       WHY      takes N instructions; not analysed
"""

import re

from wcet.bound.image import Unbounded

KINDS = {"loop": 3, "words": 2, "calls": 3, "reaches": 4, "targets": 3, "assume": 3}


class Facts:
    """`values` are the numbers that facts may name, such as kDof."""

    def __init__(self, path, values):
        self.values, self.facts, self._places, self._used = values, [], {}, set()
        for number, line in enumerate(open(path, encoding="utf-8"), 1):
            words = re.split(r"\s{2,}", line.split("#")[0].strip())
            if words != [""]:
                if KINDS.get(words[0]) != len(words) - 1:
                    raise Unbounded(f"{path}:{number}: not a fact: {line.strip()}")
                self.facts.append(tuple(words))
                self._places[tuple(words)] = f"{path}:{number}"

    def add(self, *words):
        self.facts.append(words)

    def use(self, words):
        """Notes that a fact has changed the analysis."""
        self._used.add(words)

    def refuse_unused(self):
        """Refuses facts of the file that nothing in the image needs: its function, line or loop is not there any more."""
        unused = [f"{place}: {' '.join(words)}" for words, place in self._places.items() if words not in self._used]
        if unused:
            raise Unbounded("facts that the image does not need; delete them:\n  " + "\n  ".join(unused))

    def of(self, kind, function):
        """Returns the facts of a kind about a function, whole."""
        return [words for words in self.facts if words[0] == kind and re.search(words[1], function.written)]

    def number(self, text):
        if text in self.values:
            return self.values[text]
        if not re.fullmatch(r"\d+", str(text)):
            raise Unbounded(f"{text} is neither a number nor a constant of the board")
        return int(text)

    def loop(self, function, file, line, text):
        """Returns the fact about the loop with this header, or None."""
        about = lambda where: f"/{file}:{line}".endswith("/" + where) or re.search(where, text)
        return next((words for words in self.of("loop", function) if about(words[2])), None)

    def size(self, function):
        """Returns the register that says how many bytes a function copies, or None if it does not copy."""
        for words in self.of("words", function):
            self.use(words)
            return words[2]
        return None

    def targets(self, function, text):
        """Returns patterns of the targets of a call through a pointer, or None without a fact."""
        found = [words for words in self.of("targets", function) if re.search(words[2], text)]
        for words in found:
            self.use(words)
        return [words[3] for words in found] or None

    def assumed(self, function):
        for words in self.of("assume", function):
            self.use(words)
            return self.number(words[2])
        return None
