// Semihosting: requests of a program on an emulated core to the machine that emulates it, by a
// breakpoint with a number. [Arm, Semihosting for AArch32 and AArch64, 2.0]
#pragma once

#include <cstddef>
#include <cstdint>

namespace semihosting {

inline int call(int operation, const void* argument) {
  register int r0 asm("r0") = operation;
  register const void* r1 asm("r1") = argument;
  asm volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
  return r0;
}

void print(const char* text);
void print(std::uint32_t number);
/// Reads the whole file into `buffer` if it fits; returns its size, 0 if there is no such file.
std::size_t read_file(const char* path, std::uint8_t* buffer, std::size_t capacity);
/// The last word of the emulator's command line; `line` holds it.
const char* last_argument(char* line, std::size_t capacity);
/// Ends the emulator with this exit code.
[[noreturn]] void exit(int code);

}  // namespace semihosting
