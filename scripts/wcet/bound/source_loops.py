"""Reads from a loop of our sources the LoopBound that it names; the tests check the number as they run.

    LoopBound<15> halvings;
    while (found - before > 1) {
      halvings.tick();

The form is narrow, so that every run of the body ticks exactly once: one header on a line, the tick first in the body, one
declaration in sight of it. Whatever else is refused, with a remedy.
"""

import ast
import functools
import operator
import re

from wcet.bound.image import ROOT, Unbounded

INTEGER = r"(?:std::size_t|std::int32_t|std::uint32_t|int|Eigen::Index)"
CONSTANT = re.compile(rf"constexpr\s+{INTEGER}\s+(k\w+)\s*=\s*([^;]+);")
ANOTHER = re.compile(r"\b(k\w+)\s*=\s*((?:(?!,\s*k\w+\s*=).)+)", re.DOTALL)
DECLARED = r"\b(?!return\b|case\b)\w+\s+%s\s*(?:=(?!=)|[,;{(>]|\s\w)"
HEADER = re.compile(r"\b(for|while)\s*\(")
IGNORED = re.compile(r"""//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|(?<!\w)'(?:\\.|[^'\\\n])+'""", re.DOTALL)
MACRO = r"^[ \t]*#[ \t]*define\b(?:[^\n]|\\\n)*\b(?:for|LoopBound|tick|while(?!\s*\(false\)))\b"
UNREADABLE = re.compile(r"^[ \t]*#[ \t]*(?:line\b|\d)[^\n]*|\bgoto\b|" + MACRO, re.MULTILINE)
OPERATIONS = {ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.floordiv}
LARGEST = (1 << 31) - 1


class Loop:
    """A loop of a source file: first and last line of its header, and the texts of header, body and code before."""

    def __init__(self, file, first, last, header, body, before):
        self.file, self.first, self.last = file, first, last
        self.header, self.body, self.before = header, body, before


def code(text):
    """Returns a text without comments and the contents of literals; line numbers stay."""
    return IGNORED.sub(lambda m: ("\n" * m[0].count("\n") or " ") if m[0][0] == "/" else m[0][0] * 2, text)


def closing(text, opening):
    """Returns the index at which the bracket at `opening` is closed."""
    depth, pairs = 0, {"(": ")", "{": "}"}
    left, right = text[opening], pairs[text[opening]]
    for at in range(opening, len(text)):
        depth += (text[at] == left) - (text[at] == right)
        if depth == 0:
            return at
    raise ValueError("a bracket that is never closed")


@functools.lru_cache(maxsize=None)
def source(file):
    return code((ROOT / file).read_text(encoding="utf-8"))


@functools.lru_cache(maxsize=None)
def loops_of(file):
    text, found = source(file), []
    line = lambda at: text.count("\n", 0, at) + 1
    for match in HEADER.finditer(text):
        end = closing(text, match.end() - 1)
        begin = re.compile(r"\s*").match(text, end + 1).end()
        body = text[begin : closing(text, begin) + 1] if text[begin : begin + 1] == "{" else ""
        found.append(Loop(file, line(match.start()), line(end), text[match.end() : end], body, text[: match.start()]))
    return found


@functools.lru_cache(maxsize=None)
def refuse_unreadable(file):
    """Refuses a file in which lines do not tell which loop they belong to."""
    if bad := UNREADABLE.search(source(file)):
        what = "a loop made by the preprocessor" if "define" in bad[0] else bad[0].strip()
        line = file + f":{source(file).count(chr(10), 0, bad.start()) + 1}"
        raise Unbounded(f"{line}: {what}: lines do not tell which loop they belong to; write the loop out")


@functools.lru_cache(maxsize=None)
def constants_of(files):
    """Returns the texts of the values of each constant."""
    table = {}
    for file in files:
        for first, values in CONSTANT.findall(source(file)):
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
        """Returns the loop whose header includes this line, or None. Two headers on one line cannot be told apart."""
        if file.startswith(("/", "build/")) or not (ROOT / file).is_file():
            return None
        found = [loop for loop in loops_of(file) if loop.first <= line <= loop.last]
        if len(found) > 1:
            raise Unbounded(f"{file}:{line}: {len(found)} loops begin on this line; give each its own")
        return found[0] if found else None

    def bound(self, loop):
        """Returns how often the body runs at most, each time the loop is entered."""
        place = f"{loop.file}:{loop.first}"
        for file in (loop.file, *kernel_files()):
            refuse_unreadable(file)
        tick = re.match(r"\{[ \t]*\n\s*(\w+)\.tick\(\);", loop.body)
        if not tick:
            late = "its tick() is not first in its body" if ".tick()" in loop.body else "it has no counter and no LoopBound"
            raise Unbounded(f"{place}: a loop without a bound: ({' '.join(loop.header.split())}): {late}")
        declared = [
            match[1]
            for match in re.finditer(rf"LoopBound<([^;]+)>\s+{tick[1]};", loop.before)
            if in_sight(loop.before[match.end() :])
        ]
        if len(declared) != 1:
            raise Unbounded(f"{place}: a loop without a bound: {len(declared)} declarations of {tick[1]} in sight")
        return self.value(declared[0], loop.file, place)

    def value(self, expression, file, place):
        """Evaluates a constant expression of numbers and names of constants. No part of it may be negative, because the
        type of a constant may have no sign."""
        refuse = lambda why: Unbounded(f"{place}: a loop without a bound: '{expression.strip()}': {why}")

        def of(node):
            if isinstance(node, ast.Constant) and type(node.value) is int:
                found = node.value
            elif isinstance(node, ast.Name):
                found = self._constant(node.id, file, place)
            elif isinstance(node, ast.BinOp) and type(node.op) in OPERATIONS:
                left, right = of(node.left), of(node.right)
                if isinstance(node.op, ast.Div) and right == 0:
                    raise refuse("divided by zero")
                found = OPERATIONS[type(node.op)](left, right)
            else:
                raise refuse("not a sum or product of constants")
            if not 0 <= found <= LARGEST:
                raise refuse(f"a part of it is {found}")
            return found

        try:
            plain = re.sub(r"\bR::(?=kDof\b)", "", expression)  # R: the one robot of the image
            return of(ast.parse(" ".join(plain.split()), mode="eval").body)
        except SyntaxError:
            raise refuse("not a sum or product of constants") from None

    def _constant(self, name, file, place):
        if name in self.known:
            return self.known[name]
        own = constants_of((file,)).get(name, set())
        declared = len(re.findall(DECLARED % name, source(file)))
        values = own or constants_of(kernel_files()).get(name, set())
        if len(values) != 1 or declared > len(own):
            times = max(len(values), declared)
            raise Unbounded(f"{place}: a loop without a bound: {name} is declared {times} times; write the number")
        return self.value(next(iter(values)), file, place)


def in_sight(between):
    """Returns True if a name that is declared before this text can be seen behind it."""
    depth = 0
    for each in between:
        depth += (each == "{") - (each == "}")
        if depth < 0:
            return False
    return True
