"""How often a loop of our sources runs, read from the loop itself.

    for (int i = 0; i < kDof; ++i)            counts between constants: nothing more to say
    for (const double x : {a, b, c})          counts its list
    while (found - before > 1) {              anything else names its bound, which the tests check as they run:
      halvings.tick();                          LoopBound<31> halvings; stands before the loop

A LoopBound that a function is given by reference bounds the sum of all loops that tick it.
"""

import functools
import re

from wcet.image import ROOT, Unbounded

CONSTANT = re.compile(r"constexpr\s+(?:std::size_t|int|Eigen::Index)\s+(k\w+)\s*=\s*([^;]+);")
ANOTHER = re.compile(r"\b(k\w+)\s*=\s*((?:(?!,\s*k\w+\s*=).)+)", re.DOTALL)
ARRAY = re.compile(r"std::array<[^;{}()]*?,\s*([^<>;]+?)>\s*&?\s*(\w+)\s*[;{=(,)]")
ALIAS = re.compile(r"using\s+(\w+)\s*=\s*std::array<[^;]*?,\s*([^<>;]+?)>;")
HEADER = re.compile(r"\b(for|while)\s*\(")


class Loop:
    """A loop of a source file: first and last line of its header, and what its header and its body say."""

    def __init__(self, file, first, last, header, body, before):
        self.file, self.first, self.last = file, first, last
        self.header, self.body, self.before = header, body, before


def without_comments(text):
    return re.sub(r"//[^\n]*", "", text)


def closing(text, opening):
    """Where the bracket at `opening` is closed."""
    depth, pairs = 0, {"(": ")", "{": "}"}
    left, right = text[opening], pairs[text[opening]]
    for at in range(opening, len(text)):
        depth += (text[at] == left) - (text[at] == right)
        if depth == 0:
            return at
    raise ValueError("a bracket that is never closed")


@functools.lru_cache(maxsize=None)
def loops_of(file):
    text, found = without_comments((ROOT / file).read_text(encoding="utf-8")), []
    line = lambda at: text.count("\n", 0, at) + 1
    for match in HEADER.finditer(text):
        end = closing(text, match.end() - 1)
        begin = re.compile(r"\s*").match(text, end + 1).end()
        body = text[begin : closing(text, begin) + 1] if text[begin : begin + 1] == "{" else ""
        found.append(Loop(file, line(match.start()), line(end), text[match.end() : end], body, text[: match.start()]))
    return found


@functools.lru_cache(maxsize=None)
def constants_of(files):
    table = {}
    for file in files:
        for first, values in CONSTANT.findall(without_comments((ROOT / file).read_text(encoding="utf-8"))):
            for name, value in ANOTHER.findall(f"{first} = {values}"):  # one declaration may hold several
                table.setdefault(name, set()).add(" ".join(value.split()))
    return table


@functools.lru_cache(maxsize=None)
def kernel_files():
    return tuple(sorted(p.relative_to(ROOT).as_posix() for p in (ROOT / "kernel").rglob("*.[ch]pp")))


class SourceLoops:
    """`known` holds constants that depend on the board, such as kDof."""

    def __init__(self, known):
        self.known = known

    def at(self, file, line):
        """The loop whose header stands at this line, or None."""
        if file.startswith("/") or not (ROOT / file).is_file():
            return None
        return next((loop for loop in loops_of(file) if loop.first <= line <= loop.last), None)

    def shared(self, loop):
        """The name of the LoopBound that the loop's function was given by reference, or None."""
        tick = re.search(r"(\w+)\.tick\(\)", loop.body)
        declared = tick and re.findall(r"LoopBound<[^;>]+>(&?)\s+" + tick[1] + r"\b", loop.before)
        return tick[1] if declared and declared[-1] else None

    def bound(self, loop):
        """How often the body runs at most, each time the loop is entered."""
        place = f"{loop.file}:{loop.first}"
        if tick := re.search(r"(\w+)\.tick\(\)", loop.body):
            declared = re.findall(r"LoopBound<([^;>]+)>&?\s+" + tick[1] + r"\b", loop.before)
            if not declared:
                raise Unbounded(f"{place}: {tick[1]} is no LoopBound")
            return self.value(declared[-1], loop.file, place)
        if ";" in loop.header:
            return self._counted(loop, place)
        if listed := re.search(r":\s*\{(.*)\}\s*$", loop.header, re.DOTALL):
            return listed[1].count(",") + 1
        if ranged := re.search(r":\s*([\w.]+)\s*$", loop.header):
            return self.value(ranged[1].split(".")[-1] + ".size()", loop.file, place)
        raise Unbounded(f"{place}: a loop without a bound: while ({' '.join(loop.header.split())})")

    def _counted(self, loop, place):
        begin, condition, step = (part.strip() for part in loop.header.split(";"))
        start = re.fullmatch(r"[\w:]+\s+(\w+)\s*=\s*(.+)", begin)
        if start:
            name, first = start[1], self.value(start[2], loop.file, place)
            for part in condition.split("&&"):
                if up := re.fullmatch(rf"{name}\s*(<=|<)\s*(.+)", part.strip()):
                    if step in (f"++{name}", f"{name}++"):
                        return self.value(up[2], loop.file, place) - first + (up[1] == "<=")
                if down := re.fullmatch(rf"{name}\s*(>=|>)\s*(.+)", part.strip()):
                    if step in (f"--{name}", f"{name}--"):
                        return first - self.value(down[2], loop.file, place) + (down[1] == ">=")
                if re.fullmatch(rf"{name}--\s*>\s*0", part.strip()) and not step:
                    return first
        raise Unbounded(f"{place}: a loop without a bound: for ({' '.join(loop.header.split())})")

    def value(self, expression, file, place):
        """A constant expression of numbers, names of constants and sizes of arrays."""
        expression = re.sub(r"\b\w+::(?=k[A-Z]|k$)|\b\w+::(?=k\w)", "", expression)
        expression = re.sub(r"([\w.>-]+)\.size\(\)", lambda m: f"({self._size(m[1], file, place)})", expression)
        expression = re.sub(r"\bk[A-Z]\w*", lambda m: f"({self._constant(m[0], file, place)})", expression)
        if not re.fullmatch(r"[\d\s()+*/-]+", expression):
            raise Unbounded(f"{place}: a loop without a bound: '{expression.strip()}' is no constant")
        return int(eval(expression.replace("/", "//"), {"__builtins__": {}}))

    def _constant(self, name, file, place):
        if name in self.known:
            return self.known[name]
        own = constants_of((file,)).get(name)
        values = own or constants_of(kernel_files()).get(name, set())
        if len(values) != 1:
            raise Unbounded(f"{place}: a loop without a bound: {name} has {len(values) or 'no'} values")
        return self.value(next(iter(values)), file, place)

    def _size(self, name, file, place):
        """The size of the arrays of this name in the file, which must agree."""
        header = re.sub(r"\.cpp$", ".hpp", file)
        files = [f for f in dict.fromkeys([file, header]) if (ROOT / f).is_file()]
        text = "\n".join(without_comments((ROOT / f).read_text(encoding="utf-8")) for f in files)
        sizes = {size for size, array in ARRAY.findall(text) if array == name}
        for alias, size in ALIAS.findall(text):
            if re.search(rf"\b{alias}\s*&?\s*{name}\b", text):
                sizes.add(size)
        if len(sizes) != 1:
            raise Unbounded(f"{place}: a loop without a bound: the size of {name} is not stated in {file}")
        return self.value(next(iter(sizes)), file, place)
