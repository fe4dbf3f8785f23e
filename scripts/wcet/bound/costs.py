"""The cost of an instruction in two measures.

instructions: one each, even if a condition makes it do nothing.

cycles: of a Cortex-M7 with code and data in tightly coupled memory, that is, without caches and wait states. Nothing
overlaps: each instruction is issued when the result of the one before is available, so the table holds latencies. They
are those of LLVM's scheduling model of the core (llvm/lib/Target/ARM/ARMScheduleM7.td), rounded up; a branch also
refills the pipeline, and a transfer of several registers takes one cycle for each. Arm publishes no timing of this
core, so unlike the instructions, the cycles are an estimate from above, not a proof.
"""

import re

ASSUMED = 10  # of an unknown instruction in integer code
REFILL = 8  # of a pipeline of six stages, prefetch included
CLASSES = (
    (r"v(div|sqrt)\.f64", 31),
    (r"v(div|sqrt)\.f32", 16),
    (r"v(n?ml[as]|fn?m[as])\.f64", 11),
    (r"vmul\.f64|vnmul\.f64", 7),
    (r"v(add|sub|abs|neg|maxnm|minnm|sel\w*|rint\w*)\.f\d+", 5),
    (r"vcmpe?\.f\d+|vcvt\w*\.|vmrs|vmsr", 4),
    (r"v(ldr|str|mov)", 3),
    (r"[us]div", 20),
    (r"[us]?m(ul|la|ls|ull|lal)|sml\w+|smul\w+", 3),
    (r"(ldr|str)\w*", 3),
    (r"dmb|dsb|isb|clrex|ldrex\w*|strex\w*", 10),
)
MULTIPLE = re.compile(r"(push|pop|ldm|stm|vpush|vpop|vldm|vstm)")
BRANCH = re.compile(r"(b|bl|blx|bx|cbz|cbnz|tbb|tbh)(eq|ne|cs|hs|cc|lo|mi|pl|vs|vc|hi|ls|ge|lt|gt|le)?$")


def instructions(_):
    return 1


def cycles(instruction):
    if instruction is None:
        return ASSUMED
    mnemonic = instruction.mnemonic.replace(".w", "").replace(".n", "")
    into_pc = re.search(r"\bpc\b", instruction.op_str) is not None and not mnemonic.startswith("v")
    if MULTIPLE.match(mnemonic):
        registers = len(instruction.operands)
        double = 2 if mnemonic.startswith("v") else 1
        return 3 + double * registers + (REFILL if into_pc else 0)
    if BRANCH.match(mnemonic):
        return 2 + REFILL
    cost = next((latency for pattern, latency in CLASSES if re.match(pattern, mnemonic)), 2)
    return cost + (REFILL if into_pc and mnemonic.startswith(("ldr", "mov", "add")) else 0)


MEASURES = {"instructions": instructions, "cycles": cycles}
