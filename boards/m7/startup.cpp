// The start of a Cortex-M7 from reset to program(): stacks, FPU, .data, .bss, constructors, guards.
// Cycles and other handlers have one stack, background work has another, faults a third.
#include "boards/m7/registers.hpp"

extern "C" {
extern std::uint32_t cycle_stack_top, cycle_stack_guard, work_stack_guard, data_start, data_end,
    data_load, bss_start, bss_end;
using Constructor = void (*)();
extern Constructor constructors_start[], constructors_end[];
[[noreturn]] void program();
[[noreturn]] void on_reset();
[[noreturn]] void run_program();
void on_fault();
void on_timer();
}

namespace {

using namespace m7;

/// The 4 KiB below a stack are protected: an overflow is a fault. They are more than the frame of
/// any function has, so none can step over them.
void guard_stack(std::uint32_t region, const std::uint32_t& guard) {
  at(kMpuRnr) = region;
  at(kMpuRbar) = static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(&guard));
  at(kMpuRasr) = 1U << 28 | 11U << 1 | 1U;  // execute never, no access, 2^(11+1) bytes, on
}

}  // namespace

/// Switches the FPU on before any compiled code may use it, and leaves the stack that handlers have
/// for that of background work.
extern "C" [[gnu::naked, gnu::used]] void on_reset() {
  asm volatile(
      "ldr r0, =0xE000ED88\n ldr r1, [r0]\n orr r1, r1, #(0xF << 20)\n str r1, [r0]\n dsb\n isb\n"
      "ldr r0, =work_stack_top\n msr psp, r0\n movs r0, #2\n msr control, r0\n isb\n"
      "bl run_program\n");
}

extern "C" [[gnu::used]] void run_program() {
  const std::uint32_t* from = &data_load;
  for (std::uint32_t* to = &data_start; to < &data_end; ++to) *to = *from++;
  for (std::uint32_t* to = &bss_start; to < &bss_end; ++to) *to = 0;
  guard_stack(0, cycle_stack_guard);
  guard_stack(1, work_stack_guard);
  at(kMpuCtrl) = 5U;  // on; elsewhere the default map
  at(kShcsr) = at(kShcsr) | kFaultsEnabled;
  at(kCcr) = at(kCcr) | kDivisionTraps;
  for (Constructor* each = constructors_start; each != constructors_end; ++each) (*each)();
  program();
}

[[gnu::section(".vectors"), gnu::used]] static const void* const vectors[16 + 9] = {
    &cycle_stack_top,
    reinterpret_cast<void*>(on_reset),
    reinterpret_cast<void*>(on_fault),  // NMI: the watchdog
    reinterpret_cast<void*>(on_fault),
    reinterpret_cast<void*>(on_fault),
    reinterpret_cast<void*>(on_fault),
    reinterpret_cast<void*>(on_fault),
    reinterpret_cast<void*>(on_fault),
    nullptr,
    nullptr,
    nullptr,
    reinterpret_cast<void*>(on_fault),
    reinterpret_cast<void*>(on_fault),
    nullptr,
    reinterpret_cast<void*>(on_fault),
    reinterpret_cast<void*>(on_fault),
    nullptr,
    nullptr,
    nullptr,
    nullptr,
    nullptr,
    nullptr,
    nullptr,
    nullptr,
    reinterpret_cast<void*>(on_timer)};  // interrupt 8
