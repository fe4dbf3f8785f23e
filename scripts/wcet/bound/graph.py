"""The control-flow graph of one function of the image, recovered from its instructions."""

import re

from capstone.arm import ARM_CC_AL, ARM_CC_INVALID, ARM_OP_IMM, ARM_OP_REG, ARM_REG_LR, ARM_REG_PC

from wcet.bound.image import Unbounded

CONDITION = "eq ne cs hs cc lo mi pl vs vc hi ls ge lt gt le".split()
BRANCHES = {"b"} | {"b" + condition for condition in CONDITION}
# Functions that never return; a path that ends in one is not a path of a cycle.
NO_RETURN = {"abort", "__assert_fail", "__aeabi_idiv0", "__aeabi_ldiv0"}


class Block:
    """Instructions without a branch between them, their successors, and whether they may leave the function."""

    def __init__(self, instructions, successors, leaves):
        self.instructions, self.successors, self.leaves = instructions, successors, leaves
        self.last = instructions[-1].address


class Graph:
    """Blocks by first address; targets of calls by address of the instruction, None for a call through a pointer."""

    def __init__(self, image, function):
        self.image, self.function = image, function
        self.blocks, self.calls = {}, {}
        self._code, self._ends, self._heads = {}, {}, {function.begin}
        self._follow()
        self._cut()
        self.before = {head: [] for head in self.blocks}
        for head, block in self.blocks.items():
            for successor in block.successors:
                self.before[successor].append(head)

    def _fail(self, address, why):
        raise Unbounded(f"{self.function}: {why} at {self.image.place(address)}")

    def _follow(self):
        """Reads every instruction that can be reached from the first one."""
        work = [self.function.begin]
        while work:
            address = work.pop()
            while address not in self._code:
                if not self.function.begin <= address < self.function.end:
                    self._fail(address, "the flow leaves the function")
                instruction = self.image.decode(address, self.function.end)
                if instruction is None:
                    self._fail(address, "an instruction that cannot be decoded")
                self._code[address] = instruction
                after = address + instruction.size
                end = self._end_of(instruction, after)
                if end is not None:
                    self._ends[address] = end
                    self._heads.update(end[0])
                    work += end[0]
                    break
                address = after

    def _end_of(self, i, after):
        """Returns (successors, leaves) of an instruction that ends a block, None for any other."""
        name, conditional = i.mnemonic.split(".")[0], i.cc not in (ARM_CC_AL, ARM_CC_INVALID)
        inside = lambda a: self.function.begin <= a < self.function.end
        if name in ("cbz", "cbnz"):
            return [i.operands[1].imm, after], False
        if name in BRANCHES:
            target, onward = i.operands[0].imm, [after] if conditional else []
            if inside(target):
                return [target, *onward], False
            return self._tail(i, target & ~1, onward)
        if re.fullmatch("blx?(" + "|".join(CONDITION) + ")?", name):
            target = i.operands[0].imm & ~1 if i.operands[0].type == ARM_OP_IMM else None
            return self._call(i, target, after)
        if name.startswith("bx"):
            if i.operands[0].reg != ARM_REG_LR:
                return self._tail(i, None, [after] if conditional else [])
            return [after] if conditional else [], True
        if name in ("tbb", "tbh"):
            return self._table(i), False
        if self._returns(i, name):
            return [after] if conditional else [], True
        return ([], False) if name == "udf" else None

    def _call(self, i, target, after):
        callee = self.image.function_at(target) if target is not None else None
        if callee is not None and callee.symbol in NO_RETURN:
            return [], False
        self.calls[i.address] = target
        return [after], False

    def _tail(self, i, target, onward):
        self.calls[i.address] = target
        return onward, True

    def _returns(self, i, name):
        """Returns True if the instruction loads the program counter from the stack; refuses loads from elsewhere."""
        into_pc = lambda operands: any(o.type == ARM_OP_REG and o.reg == ARM_REG_PC for o in operands)
        if name.startswith("pop"):
            return into_pc(i.operands)
        loads, jumps = name.startswith("ldm"), name.startswith(("ldr", "mov", "add", "sub"))
        if not into_pc(i.operands[1:] if loads else i.operands[:1] if jumps else []):
            return False
        if not re.match(r"sp!, \{" if loads else r"pc, \[sp\], #", i.op_str) or name.startswith(("mov", "add", "sub")):
            self._fail(i.address, "a computed jump")
        return True

    def _table(self, i):
        """Returns the targets of a jump table; _checked() gives its size."""
        size, address = 2 if i.mnemonic.startswith("tbh") else 1, i.address + i.size
        raw = self.image.read(address, size * self._checked(i))
        steps = [int.from_bytes(raw[k : k + size], "little") for k in range(0, len(raw), size)]
        return sorted({address + 2 * step for step in steps})

    def _checked(self, i):
        """Returns the number of entries of a jump table: the instructions before it compare its index and branch if higher."""
        index, later = i.operands[0].mem.index, i
        for p in reversed([self._code[a] for a in sorted(self._code) if a < i.address]):
            if p.address + p.size != later.address or index in p.regs_access()[1]:
                break
            compares = p.mnemonic.startswith("cmp") and p.operands[0].reg == index and p.operands[1].type == ARM_OP_IMM
            if compares and later.mnemonic.startswith("bhi"):
                return p.operands[1].imm + 1
            later = p
        self._fail(i.address, "a jump table of unknown size")

    def _cut(self):
        for head in self._heads:
            instructions, address = [], head
            while True:
                instructions.append(self._code[address])
                if address in self._ends:
                    successors, leaves = self._ends[address]
                    break
                address += self._code[address].size
                if address in self._heads:
                    successors, leaves = [address], False
                    break
            self.blocks[head] = Block(instructions, list(dict.fromkeys(successors)), leaves)

    def addresses(self):
        return self._code.keys()
