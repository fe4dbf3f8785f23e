// Numbers as the standards write them: "603Fh".
#pragma once

#include "kernel/core/text.hpp"

namespace tactus::cia402 {

/// Returns the number in at least four hexadecimal digits. [any]
inline Text<9> hex(std::uint32_t number) {
  const int digits = number > 0xFFFF ? 8 : 4;
  char text[9];
  for (int i = 0; i < digits; ++i)
    text[i] = "0123456789ABCDEF"[number >> (4 * (digits - 1 - i)) & 15U];
  text[digits] = 'h';
  return Text<9>(std::string_view(text, static_cast<std::size_t>(digits) + 1));
}

}  // namespace tactus::cia402
