// The handlers of an image for measurements: a fault ends the emulator with a message.
#include "boards/bare_metal/registers.hpp"
#include "tests/wcet/m7/console.hpp"

extern "C" {
extern std::uint32_t fault_stack_top;
int measure();
[[noreturn]] void program();
void on_fault();
void on_timer();
[[noreturn]] void report_fault();
}

extern "C" [[gnu::naked, gnu::used]] void on_fault() {
  asm volatile("ldr r0, =fault_stack_top\n mov sp, r0\n b report_fault\n");
}

extern "C" [[gnu::used]] void report_fault() {
  semihosting::print("fault, CFSR ");
  semihosting::print(bare::at(bare::kCfsr));
  semihosting::print("\n");
  semihosting::exit(99);
}

/// No timer runs.
extern "C" void on_timer() {
  report_fault();
}

extern "C" void program() {
  semihosting::exit(measure());
}
