#include "tests/wcet/m7/console.hpp"

namespace semihosting {

void print(const char* text) {
  static const int console = open(":tt", Mode::kWrite);  // the emulator's console, by its name
  std::size_t size = 0;
  while (text[size] != '\0') ++size;
  static_cast<void>(write(console, reinterpret_cast<const std::uint8_t*>(text), size));
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
  const int file = open(path, Mode::kRead);
  if (file < 0) return 0;
  std::uint8_t more;
  const std::size_t size = read(file, buffer, capacity);
  return read(file, &more, 1) == 0 ? size : 0;
}

}  // namespace semihosting
