"""A linked Thumb-2 image: its functions, its bytes and the source lines its addresses come from."""

import functools
import os
import pathlib
import re
import subprocess

import capstone
from elftools.elf.elffile import ELFFile

from wcet.kinds import as_written

ROOT = pathlib.Path(__file__).resolve().parents[3]
NOWHERE = 0xFFFFFFFF


class Unbounded(Exception):
    """Something has no bound; the message names the place."""


class Function:
    """A function of the image: linked name, written name, first address, end."""

    def __init__(self, symbol, written, begin, end):
        self.symbol, self.written, self.begin, self.end = symbol, written, begin, end

    def __str__(self):
        return self.written


class Image:
    def __init__(self, path):
        self.path, self._places, self._conditional = str(path), {}, {}
        command = ["arm-none-eabi-addr2line", "-e", self.path, "-i", "-a"]
        self._addr2line = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        with open(path, "rb") as file:
            elf = ELFFile(file)
            self._segments = [
                (s["p_vaddr"], s.data()) for s in elf.iter_segments() if s["p_type"] == "PT_LOAD" and s["p_filesz"]
            ]
            symbols = list(elf.get_section_by_name(".symtab").iter_symbols())
            refuse_merged(elf, self.path)
            self._ends = sorted(s["sh_addr"] + s["sh_size"] for s in elf.iter_sections() if s["sh_flags"] & 4)
        self.functions = self._read_functions(symbols)
        self.decoder = capstone.Cs(capstone.CS_ARCH_ARM, capstone.CS_MODE_THUMB | capstone.CS_MODE_MCLASS)
        self.decoder.detail = True

    def _read_functions(self, symbols):
        """Returns the functions by first address. One without a size (assembly) ends where the next one begins."""
        found = [s for s in symbols if s["st_info"]["type"] == "STT_FUNC"]
        begins = sorted({s["st_value"] & ~1 for s in found})
        written = demangled([s.name for s in found])
        functions = {}
        for symbol, name in zip(found, written):
            begin = symbol["st_value"] & ~1
            later = next((b for b in begins + self._ends if b > begin), begin)
            size = symbol["st_size"] or later - begin
            functions.setdefault(begin, Function(symbol.name, name, begin, begin + size))
        return functions

    def function_at(self, address):
        return self.functions.get(address)

    def matching(self, pattern):
        """Returns the functions whose written name contains a match of the pattern, by address."""
        return [f for _, f in sorted(self.functions.items()) if re.search(pattern, f.written)]

    def read(self, address, size):
        for begin, data in self._segments:
            if begin <= address and address + size <= begin + len(data):
                return data[address - begin : address - begin + size]
        raise Unbounded(f"the image has no bytes at 0x{address:x}")

    def decode(self, address, end):
        """Returns the instruction at an address, or None; one in an IT block has its condition."""
        if address in self._conditional:
            return self._conditional[address]
        found = next(self.decoder.disasm(self.read(address, min(4, end - address)), address, 1), None)
        if found is not None and re.fullmatch("it[te]*", found.mnemonic):
            count = len(found.mnemonic)
            block = self.decoder.disasm(self.read(address, min(2 + 4 * count, end - address)), address, count)
            self._conditional.update((i.address, i) for i in block)
        return found

    def learn_places(self, addresses):
        """Asks one addr2line process for all places; its answer to an address outside the image ends each answer."""
        for address in sorted(set(addresses) - set(self._places)):
            self._addr2line.stdin.write(f"{address:x}\n{NOWHERE:x}\n")
            self._addr2line.stdin.flush()
            here = self._places[address] = []
            for line in iter(self._addr2line.stdout.readline, f"0x{NOWHERE:08x}\n"):
                if not line:
                    raise Unbounded(f"{self.path}: addr2line has ended")
                if match := re.match(r"(?!0x)(.+):(\d+)", line):
                    here.append((relative(match[1]), int(match[2])))
            self._addr2line.stdout.readline()

    def places(self, address):
        """Returns source file and line of an address, then those of the calls it was inlined into."""
        self.learn_places([address])
        return self._places.get(address, [])

    def place(self, address):
        """Returns the innermost place as text, and the first place within the project if it is another."""
        chain = self.places(address)
        if not chain:
            return f"0x{address:x}"
        ours = next((p for p in chain if not p[0].startswith("/")), chain[0])
        names = dict.fromkeys([chain[0], ours])
        return " in ".join(f"{file}:{line}" for file, line in names) + f" (0x{address:x})"


@functools.lru_cache(maxsize=None)
def relative(file):
    """Returns a path of the project relative to its root, wherever it was compiled; other paths unchanged."""
    parts = pathlib.Path(file).parts
    for first in range(1 if parts[0] == "/" else 0, len(parts)):
        if parts[1:2] != ("usr",) and ROOT.joinpath(*parts[first:]).is_file():
            return "/".join(parts[first:])
    return os.path.normpath(file)


def refuse_merged(elf, path):
    """Refuses code of ours whose equal functions the compiler may have merged: their LoopBounds may differ."""
    for unit in elf.get_dwarf_info().iter_CUs() if elf.has_dwarf_info() else []:
        about = unit.get_top_DIE().attributes
        name, producer = (about[key].value.decode() if key in about else "" for key in ("DW_AT_name", "DW_AT_producer"))
        if name.endswith(".cpp") and not name.startswith("/") and "-fno-ipa-icf" not in producer:
            raise Unbounded(f"{path}: equal functions may be merged, whose bounds differ: compile {name} with -fno-ipa-icf")


def demangled(symbols):
    run = subprocess.run(["c++filt"], input="\n".join(symbols), capture_output=True, text=True, check=True)
    return as_written(run.stdout).splitlines()


@functools.lru_cache(maxsize=None)
def source_line(file, line):
    """Returns a line of one of our sources; "" for other files."""
    if file.startswith("/"):
        return ""
    lines = (ROOT / file).read_text(encoding="utf-8").splitlines()
    return lines[line - 1] if 0 < line <= len(lines) else ""
