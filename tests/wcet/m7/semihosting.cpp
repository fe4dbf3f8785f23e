#include "tests/wcet/m7/semihosting.hpp"

namespace semihosting {
namespace {

enum Operation : int {
  kOpen = 0x01,
  kWrite0 = 0x04,
  kRead = 0x06,
  kLength = 0x0c,
  kCommandLine = 0x15,
  kExitExtended = 0x20,
};
constexpr std::uint32_t kApplicationExit = 0x20026, kReadBinary = 1;

std::uint32_t word(const void* pointer) {
  return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(pointer));
}

}  // namespace

void print(const char* text) {
  call(kWrite0, text);
}

void print(std::uint32_t number) {
  char digits[11] = {};
  int i = 10;
  do {
    digits[--i] = static_cast<char>('0' + number % 10);
    number /= 10;
  } while (number > 0);
  print(digits + i);
}

std::size_t read_file(const char* path, std::uint8_t* buffer, std::size_t capacity) {
  std::uint32_t length = 0;
  while (path[length] != '\0') ++length;
  const std::uint32_t name[] = {word(path), kReadBinary, length};
  const int handle = call(kOpen, name);
  if (handle < 0) return 0;
  const auto file = static_cast<std::uint32_t>(handle);
  const int size = call(kLength, &file);
  if (size <= 0 || static_cast<std::size_t>(size) > capacity) return 0;
  const std::uint32_t request[] = {file, word(buffer), static_cast<std::uint32_t>(size)};
  return call(kRead, request) == 0 ? static_cast<std::size_t>(size) : 0;
}

const char* last_argument(char* line, std::size_t capacity) {
  const std::uint32_t request[] = {word(line), static_cast<std::uint32_t>(capacity)};
  if (call(kCommandLine, request) != 0) return "";
  const char* last = line;
  for (const char* c = line; *c != '\0'; ++c)
    if (*c == ' ') last = c + 1;
  return last;
}

void exit(int code) {
  const std::uint32_t request[] = {kApplicationExit, static_cast<std::uint32_t>(code)};
  call(kExitExtended, request);
  for (;;) {
  }
}

}  // namespace semihosting
