#include "boards/bare_metal/semihosting_link.hpp"

#include <algorithm>
#include <string_view>

#include "boards/bare_metal/semihosting.hpp"
#include "kernel/core/text.hpp"

namespace bare {

bool SemihostingLink::open() {
  static char line[512];
  const std::string_view folder = semihosting::last_argument(line, sizeof line);
  tactus::Text<300> in(folder), out(folder);
  in << "/to_board";
  out << "/from_board";
  in_ = semihosting::open(in.c_str(), semihosting::Mode::kRead);
  out_ = semihosting::open(out.c_str(), semihosting::Mode::kWrite);
  return in_ >= 0 && out_ >= 0;
}

void SemihostingLink::send(const std::uint8_t* bytes, std::size_t size) {
  if (size > kMost - size_) return;  // the computer misses a frame and asks again
  std::copy(bytes, bytes + size, waiting_.begin() + kHead + size_);
  size_ += size;
}

/// Reads all bytes. Without a computer an emulated board has no purpose.
void SemihostingLink::read(std::uint8_t* to, std::size_t size) {
  for (std::size_t got = 0, part = 0; got < size; got += part) {
    part = semihosting::read(in_, to + got, size - got);
    if (part == 0) semihosting::exit(0);
  }
}

std::size_t SemihostingLink::receive(std::uint8_t* to, std::size_t capacity) {
  waiting_[0] = static_cast<std::uint8_t>(size_ >> 8);
  waiting_[1] = static_cast<std::uint8_t>(size_);
  std::uint8_t head[kHead], dropped;
  if (!semihosting::write(out_, waiting_.data(), kHead + size_)) semihosting::exit(1);
  size_ = 0;
  read(head, kHead);
  const std::size_t size = static_cast<std::size_t>(head[0] << 8 | head[1]);
  read(to, std::min(size, capacity));
  for (std::size_t i = capacity; i < size; ++i)
    read(&dropped, 1);  // or the next size would be lost
  return std::min(size, capacity);
}

}  // namespace bare
