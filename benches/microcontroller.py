"""What a UR5e in single precision takes on a Cortex-M4F, in an emulator.

    python3 -m venv venv && venv/bin/pip install unicorn capstone
    ../.ci/check-single && venv/bin/python microcontroller.py

Counts the instructions of each function of tests/microcontroller, and estimates cycles by
Arm's table for that processor (DDI 0439): 1 for an instruction, 14 for a division or a root,
1 more for a load, a cycle for each register that is pushed or popped, 2 more for a jump that
is taken. Memory without wait states.
"""

import struct
import sys
from pathlib import Path

from capstone import CS_ARCH_ARM, CS_MODE_MCLASS, CS_MODE_THUMB, Cs
from unicorn import UC_ARCH_ARM, UC_HOOK_CODE, UC_MODE_MCLASS, UC_MODE_THUMB, Uc
from unicorn.arm_const import UC_ARM_REG_LR, UC_ARM_REG_R0, UC_ARM_REG_SP, UC_CPU_ARM_CORTEX_M4

ELF = Path(__file__).parent / "../target/thumbv7em-none-eabihf/release/microcontroller"
FUNCTIONS = ["pose", "pose_and_jacobian", "solutions", "nearest"]
STACK = 0x2000_0000, 0x10_0000
PAGE = 0x1000
# Coprocessor access control: the unit for floating point is off after reset.
CPACR = 0xE000_ED88


class Program:
    """The sections that are loaded, and the addresses of functions."""

    def __init__(self, data):
        sections, at = [], struct.unpack_from("<I", data, 0x20)[0]
        size, count = struct.unpack_from("<HH", data, 0x2E)
        for i in range(count):
            sections.append(struct.unpack_from("<10I", data, at + i * size))
        self.loaded = [
            (s[3], data[s[4] : s[4] + s[5]]) for s in sections if s[2] & 2 and s[1] == 1
        ]
        self.symbols = {}
        for _, kind, _, _, offset, length, link, *_ in sections:
            if kind != 2:
                continue
            names = sections[link][4]
            for entry in range(offset, offset + length, 16):
                name, value, _, info, *_ = struct.unpack_from("<IIIBBH", data, entry)
                end = data.index(b"\0", names + name)
                if info & 15 == 2:
                    self.symbols[data[names + name : end].decode()] = value & ~1


def cycles(instruction, taken):
    name, operands = instruction.mnemonic, instruction.op_str
    if name.startswith(("vdiv", "vsqrt")):
        return 14
    if name.startswith(("push", "pop", "vpush", "vpop", "ldm", "stm", "vldm", "vstm")):
        registers = operands[operands.index("{") :].split(",")
        return 1 + len(registers) + 2 * taken
    return 1 + name.startswith(("ldr", "vldr")) + name.startswith(("ldrd", "strd")) + 2 * taken


class Counter:
    """Counts what runs from the beginning of each function to its return, and hears whether the
    whole was right."""

    def __init__(self, symbols):
        self.names = {symbols[name]: name for name in FUNCTIONS}
        self.decoder = Cs(CS_ARCH_ARM, CS_MODE_THUMB | CS_MODE_MCLASS)
        self.decoded = {}
        self.counting = None
        self.last = None
        self.whole = symbols["comes_back"]
        self.end = None
        self.right = False
        self.found = {}

    def decode(self, cpu, at, size):
        if at not in self.decoded:
            code = bytes(cpu.mem_read(at, size))
            self.decoded[at] = next(self.decoder.disasm(code, at), None)
        return self.decoded[at]

    def step(self, cpu, at, size, _):
        if self.last and self.counting:
            before, length = self.last
            self.total[0] += 1
            self.total[1] += cycles(self.decode(cpu, before, length), at != before + length)
        self.last = at, size
        if self.counting and at == self.back:
            self.found.setdefault(self.counting, tuple(self.total))
            self.counting = None
        if not self.counting and at in self.names:
            self.counting, self.total = self.names[at], [0, 0]
            self.back = cpu.reg_read(UC_ARM_REG_LR) & ~1
        if at == self.whole:
            self.end = cpu.reg_read(UC_ARM_REG_LR) & ~1
        if at == self.end:
            self.right = cpu.reg_read(UC_ARM_REG_R0) & 1
            cpu.emu_stop()


def main():
    program = Program(ELF.read_bytes())
    cpu = Uc(UC_ARCH_ARM, UC_MODE_THUMB | UC_MODE_MCLASS)
    cpu.ctl_set_cpu_model(UC_CPU_ARM_CORTEX_M4)
    last = max(at + len(content) for at, content in program.loaded)
    cpu.mem_map(0, -(-last // PAGE) * PAGE)
    for at, content in program.loaded:
        cpu.mem_write(at, content)
    cpu.mem_map(*STACK)
    cpu.reg_write(UC_ARM_REG_SP, sum(STACK) - 16)
    enable(cpu)
    counter = Counter(program.symbols)
    cpu.hook_add(UC_HOOK_CODE, counter.step)
    cpu.emu_start(program.symbols["_start"] | 1, 0, count=10_000_000)
    if not counter.right:
        return "the solutions are wrong"
    print("| | instructions | cycles, about |\n|---|---|---|")
    for name in FUNCTIONS:
        instructions, estimate = counter.found[name]
        print(f"| {name.replace('_', ' ')} | {instructions} | {estimate} |")


def enable(cpu):
    """Turns the unit for floating point on, as the code before `main` of a controller does."""
    try:
        cpu.mem_map(CPACR & ~(PAGE - 1), PAGE)
    except Exception:  # the emulator has it mapped
        pass
    # movw r0, #0xed88; movt r0, #0xe000; ldr r1, [r0]; orr r1, #0xf00000; str r1, [r0]; isb
    code = bytes.fromhex("4ef68850 cef20000 0168 41f47001 0160 bff36f8f".replace(" ", ""))
    at = STACK[0]
    cpu.mem_write(at, code)
    cpu.emu_start(at | 1, at + len(code))


if __name__ == "__main__":
    sys.exit(main())
