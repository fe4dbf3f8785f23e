"""The call graph that GCC writes next to every object (-fstack-usage -fcallgraph-info=su), and the stack of a function.

A stack without a bound is an error that names the place: recursion, frames of varying size, calls through a pointer
without known targets, functions without a known frame. Heap calls are listed.
"""

import re
import subprocess

from wcet.kinds import as_written

NODE = re.compile(r'node: \{ title: "([^"]*)" label: "([^"]*)"')
EDGE = re.compile(r'edge: \{ sourcename: "([^"]*)" targetname: "([^"]*)"(?: label: "([^"]*)")?')
FRAME = re.compile(r"(\d+) bytes \(([\w,]+)\)")
HEAP = re.compile(r"^(_Zn[wa]\w*|_Zd[la]\w*|malloc|calloc|realloc|free|aligned_alloc|posix_memalign|strdup)$")
INDIRECT = "__indirect_call"


class Unbounded(Exception):
    pass


class Function:
    """A function: its names, its place, its frame in bytes, and its calls: (symbol, place)."""

    def __init__(self, symbol, written, place, frame, kind):
        self.symbol, self.written, self.place, self.frame, self.kind = symbol, written, place, frame, kind
        self.calls = []

    def __str__(self):
        return f"{self.written} ({self.place})"


class CallGraph:
    """`files` are the files of GCC; `rules` the lines of a file of call targets and of frames of library functions."""

    def __init__(self, files, rules):
        self.functions, self.copies, self.targets, self.elsewhere, self._below, self._active = {}, {}, [], [], {}, []
        for line in rules:
            words = re.split(r"\s{2,}", line.split("#")[0].strip())
            if words[0] == "targets":
                self.targets.append(words[1:])
            elif words[0] == "frame":
                self.elsewhere.append((words[1], int(words[2])))
        for file in files:
            self._read(file)

    def _read(self, file):
        names, edges = {}, []
        for line in open(file, encoding="utf-8"):
            if node := NODE.search(line):
                written, *rest = as_written(node[2]).split("\\n")
                frame = FRAME.search(node[2])
                if frame:
                    kind = "static" if "static" in frame[2] or "bounded" in frame[2] else frame[2]
                    function = Function(node[1], written, rest[0], int(frame[1]), kind)
                    names[node[1]] = self.functions.setdefault(node[1], function)
                    self.copies.setdefault(node[1].rsplit(":", 1)[-1], []).append(names[node[1]])
            elif edge := EDGE.search(line):
                edges.append(edge.groups())
        for caller, callee, place in edges:
            if caller in names:
                names[caller].calls.append((callee, place or names[caller].place))

    def matching(self, pattern):
        return [f for f in self.functions.values() if re.search(pattern, f.written)]

    def heap_calls(self):
        """Returns every heap call as text."""
        return sorted({
            f"{place}: {function.written} calls {readable(callee)}"
            for function in self.functions.values()
            for callee, place in function.calls
            if HEAP.match(callee.rsplit(":", 1)[-1])
        })

    def below(self, function):
        """Returns (bytes, functions on the deepest path) of a function and everything it calls."""
        if function.symbol in self._below:
            return self._below[function.symbol]
        if function in self._active:
            around = self._active[self._active.index(function) :] + [function]
            raise Unbounded("recursion: " + " > ".join(map(str, around)))
        if function.kind != "static":
            raise Unbounded(f"a frame of varying size: {function}")
        self._active.append(function)
        deepest, way = 0, []
        for callee, place in function.calls:
            size, path = self._called(function, callee, place)
            if size > deepest:
                deepest, way = size, path
        self._active.pop()
        found = function.frame + deepest, [function, *way]
        self._below[function.symbol] = found
        return found

    def _called(self, function, callee, place):
        if callee == INDIRECT:
            return max((self.below(f) for f in self._pointed_to(function, place)), key=lambda b: b[0], default=(0, []))
        if known := self._known(callee):
            return max((self.below(f) for f in known), key=lambda b: b[0])
        for pattern, frame in self.elsewhere:
            if re.search(pattern, callee):
                return frame, [Function(callee, callee, "library", frame, "static")]
        raise Unbounded(f"{place}: {function.written} calls {readable(callee)}, whose stack is not known")

    def _known(self, callee):
        """Finds a function by its title, or its copies in all files by symbol; C1 constructors are aliases of C2."""
        if callee in self.functions:
            return [self.functions[callee]]
        plain = callee.rsplit(":", 1)[-1]
        return self.copies.get(plain) or self.copies.get(re.sub(r"C1(?=E)", "C2", plain))

    def _pointed_to(self, function, place):
        """Returns the possible targets of a call through a pointer, by the text of its source line."""
        text = source_line(place)
        for caller, line, callee in self.targets:
            if re.search(caller, function.written) and re.search(line, text):
                if callee == "none":
                    return []
                if found := self.matching(callee):
                    return found
        raise Unbounded(f"{place}: {function.written}: a call through a pointer without known targets: {text.strip()}")


def source_line(place):
    match = re.match(r"(.+?):(\d+)", place)
    try:
        return open(match[1], encoding="utf-8").read().splitlines()[int(match[2]) - 1]
    except (OSError, IndexError, TypeError):
        return ""


def readable(symbol):
    return as_written(subprocess.run(["c++filt", symbol], capture_output=True, text=True, check=True).stdout.strip())
