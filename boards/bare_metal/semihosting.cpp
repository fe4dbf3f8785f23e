#include "boards/bare_metal/semihosting.hpp"

namespace semihosting {
namespace {

enum Operation : int {
  kOpen = 0x01,
  kWrite = 0x05,
  kRead = 0x06,
  kCommandLine = 0x15,
  kExitExtended = 0x20,
};
constexpr std::uint32_t kApplicationExit = 0x20026;

int call(Operation operation, const std::uint32_t* argument) {
  register int r0 asm("r0") = operation;
  register const std::uint32_t* r1 asm("r1") = argument;
  asm volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
  return r0;
}

std::uint32_t word(const void* pointer) {
  return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(pointer));
}

/// Calls with a file, a buffer and its size; the answer is the number of bytes that are left.
std::size_t transferred(Operation operation, int file, const std::uint8_t* bytes,
                        std::size_t size) {
  const std::uint32_t request[] = {static_cast<std::uint32_t>(file), word(bytes), size};
  const int left = call(operation, request);
  return left < 0 || static_cast<std::size_t>(left) > size ? 0
                                                           : size - static_cast<std::size_t>(left);
}

}  // namespace

const char* last_argument(char* line, std::size_t capacity) {
  const std::uint32_t request[] = {word(line), static_cast<std::uint32_t>(capacity)};
  if (call(kCommandLine, request) != 0) return "";
  const char* last = line;
  for (const char* c = line; *c != '\0'; ++c)
    if (*c == ' ') last = c + 1;
  return last;
}

int open(const char* path, Mode mode) {
  std::uint32_t length = 0;
  while (path[length] != '\0') ++length;
  const std::uint32_t request[] = {word(path), static_cast<std::uint32_t>(mode), length};
  return call(kOpen, request);
}

std::size_t read(int file, std::uint8_t* to, std::size_t size) {
  return transferred(kRead, file, to, size);
}

bool write(int file, const std::uint8_t* from, std::size_t size) {
  return transferred(kWrite, file, from, size) == size;
}

void exit(int code) {
  const std::uint32_t request[] = {kApplicationExit, static_cast<std::uint32_t>(code)};
  call(kExitExtended, request);
  for (;;) {
  }
}

}  // namespace semihosting
