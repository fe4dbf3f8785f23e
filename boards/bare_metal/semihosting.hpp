// Semihosting: requests of a program on an emulated core to the machine that emulates it, by a
// breakpoint with a number. [Arm, Semihosting for AArch32 and AArch64, 2.0]
#pragma once

#include <cstddef>
#include <cstdint>

namespace semihosting {

/// The last word of the emulator's command line; `line` holds it.
const char* last_argument(char* line, std::size_t capacity);

enum class Mode : std::uint32_t { kRead = 1, kWrite = 5 };  // binary
/// Opens a file of the host; negative: there is none. Waits for the other end of a named pipe.
int open(const char* path, Mode mode);
/// Reads up to `size` bytes, at least one unless the other end was closed; returns their number.
std::size_t read(int file, std::uint8_t* to, std::size_t size);
/// Writes all bytes; false: not all were taken.
bool write(int file, const std::uint8_t* from, std::size_t size);
/// Ends the emulator with this exit code.
[[noreturn]] void exit(int code);

}  // namespace semihosting
