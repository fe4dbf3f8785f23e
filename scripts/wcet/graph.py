"""The control-flow graph of one function of the image, recovered from its instructions."""

import re

from capstone.arm import ARM_CC_AL, ARM_CC_INVALID, ARM_OP_IMM, ARM_OP_REG, ARM_REG_LR, ARM_REG_PC

from wcet.image import Unbounded

CONDITION = "eq ne cs hs cc lo mi pl vs vc hi ls ge lt gt le".split()
BRANCHES = {"b"} | {"b" + condition for condition in CONDITION}
# What a cycle never comes back from; paths that end there are no paths of a cycle.
NO_RETURN = {"abort", "__assert_fail", "__aeabi_idiv0", "__aeabi_ldiv0"}


class Block:
    """Instructions without a branch among them; where they go on; whether they may leave the function."""

    def __init__(self, instructions, successors, leaves):
        self.instructions, self.successors, self.leaves = instructions, successors, leaves
        self.last = instructions[-1].address


class Graph:
    """Blocks by first address, calls by address of the instruction. A call through a pointer has the target None."""

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
        """Reads every instruction that can be reached, from the first one on."""
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
        """(successors, leaves) of an instruction that ends a block, None of one that does not."""
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
        """True for an instruction that loads the program counter from the stack; any other such load is refused."""
        into_pc = lambda operands: any(o.type == ARM_OP_REG and o.reg == ARM_REG_PC for o in operands)
        if name.startswith("pop"):
            return into_pc(i.operands)
        if name.startswith("ldm"):
            return into_pc(i.operands[1:])
        if name.startswith(("ldr", "mov", "add")) and into_pc(i.operands[:1]):
            if not (name.startswith("ldr") and "sp" in i.op_str):
                self._fail(i.address, "a computed jump")
            return True
        return False

    def _table(self, i):
        """Targets of a jump table, whose size is that of the comparison before it."""
        size, address = 2 if i.mnemonic.startswith("tbh") else 1, i.address + i.size
        before = [self._code[a] for a in sorted(self._code) if a < i.address][-6:]
        sizes = [p.operands[1].imm + 1 for p in before if p.mnemonic.startswith("cmp") and p.operands[1].type == ARM_OP_IMM]
        if not sizes:
            self._fail(i.address, "a jump table of unknown size")
        raw = self.image.read(address, size * sizes[-1])
        steps = [int.from_bytes(raw[k : k + size], "little") for k in range(0, len(raw), size)]
        return sorted({address + 2 * step for step in steps})

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
