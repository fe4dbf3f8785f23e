// The start of a bare Cortex-M7 from reset to program(): stack, FPU, .data, .bss, constructors,
// and faults that end the emulator with a message.
#include "tests/wcet/m7/semihosting.hpp"

extern "C" {
extern std::uint32_t stack_top, stack_limit, data_start, data_end, data_load, bss_start, bss_end;
using Constructor = void (*)();
extern Constructor constructors_start[], constructors_end[];
int program();
[[noreturn]] void on_reset();
[[noreturn]] void on_fault();
[[noreturn]] void run_main();
}

namespace {

volatile std::uint32_t& at(std::uintptr_t address) {
  return *reinterpret_cast<volatile std::uint32_t*>(address);
}

// Registers of the core. [Arm, Armv7-M Architecture Reference Manual, B3.2 and B3.5]
constexpr std::uintptr_t kCcr = 0xE000ED14, kShcsr = 0xE000ED24, kCfsr = 0xE000ED28;
constexpr std::uintptr_t kMpuCtrl = 0xE000ED94, kMpuRnr = 0xE000ED98, kMpuRbar = 0xE000ED9C,
                         kMpuRasr = 0xE000EDA0;

/// The 32 bytes below the stack are protected: an overflow is a fault.
void guard_stack() {
  at(kMpuRnr) = 0;
  at(kMpuRbar) = static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(&stack_limit));
  at(kMpuRasr) = 1U << 28 | 4U << 1 | 1U;  // execute never, no access, 2^(4+1) bytes, on
  at(kMpuCtrl) = 5U;                       // on; elsewhere the default map
  at(kShcsr) = at(kShcsr) | 1U << 16;      // memory faults
  at(kCcr) = at(kCcr) | 1U << 4;           // integer division by zero traps
}

}  // namespace

/// Switches the FPU on before any compiled code may use it.
extern "C" [[gnu::naked, gnu::used]] void on_reset() {
  asm volatile(
      "ldr r0, =0xE000ED88\n ldr r1, [r0]\n orr r1, r1, #(0xF << 20)\n str r1, [r0]\n dsb\n isb\n"
      "bl run_main\n");
}

extern "C" [[gnu::used]] void run_main() {
  const std::uint32_t* from = &data_load;
  for (std::uint32_t* to = &data_start; to < &data_end; ++to) *to = *from++;
  for (std::uint32_t* to = &bss_start; to < &bss_end; ++to) *to = 0;
  for (Constructor* each = constructors_start; each != constructors_end; ++each) (*each)();
  guard_stack();
  semihosting::exit(program());
}

extern "C" void on_fault() {
  asm volatile("mov sp, %0" ::"r"(&stack_top));  // the old stack is no longer needed
  semihosting::print("fault, CFSR ");
  semihosting::print(at(kCfsr));
  semihosting::print("\n");
  semihosting::exit(99);
}

[[gnu::section(".vectors"), gnu::used]] static const void* const vectors[16] = {
    &stack_top,
    reinterpret_cast<void*>(on_reset),
    reinterpret_cast<void*>(on_fault),
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
    reinterpret_cast<void*>(on_fault)};
