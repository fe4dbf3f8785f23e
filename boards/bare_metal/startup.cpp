// The start of a board from reset to program(): stacks, FPU, .data, .bss, constructors, guards.
// Cycles and other handlers have one stack, background work has another, faults a third.
#include "boards/bare_metal/startup.hpp"

#include "boards/bare_metal/registers.hpp"

extern "C" {
extern std::uint32_t data_start, data_end, data_load, bss_start, bss_end;
using Constructor = void (*)();
extern Constructor constructors_start[], constructors_end[];
[[noreturn]] void program();
[[noreturn]] void run_program();
}

/// Switches the FPU on before any compiled code may use it, and leaves the stack that handlers have
/// for that of background work.
extern "C" [[gnu::naked, gnu::used]] void on_reset() {
  asm volatile(
      "ldr r0, =0xE000ED88\n ldr r1, [r0]\n orr r1, r1, #(0xF << 20)\n str r1, [r0]\n dsb\n isb\n"
      "ldr r0, =work_stack_top\n msr psp, r0\n movs r0, #2\n msr control, r0\n isb\n"
      "bl run_program\n");
}

extern "C" [[gnu::used]] void run_program() {
  using namespace bare;
  const std::uint32_t* from = &data_load;
  for (std::uint32_t* to = &data_start; to < &data_end; ++to) *to = *from++;
  for (std::uint32_t* to = &bss_start; to < &bss_end; ++to) *to = 0;
  guard_stacks();
  at(kShcsr) = at(kShcsr) | kFaultsEnabled;
  at(kCcr) = at(kCcr) | kDivisionTraps;
  for (Constructor* each = constructors_start; each != constructors_end; ++each) (*each)();
  program();
}
