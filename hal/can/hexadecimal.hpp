// Numbers as the CAN standards write them: "6060h", "06090030h".
#pragma once

#include <cstdint>
#include <string_view>

#include "kernel/core/text.hpp"

namespace tactus::can {

inline constexpr int kMostHexDigits = 16;

/// Returns the number's last `digits` hexadecimal digits, at most 16, and an h. [any]
inline Text<kMostHexDigits + 1> hexadecimal(std::uint64_t number, int digits) {
  Text<kMostHexDigits + 1> text;
  for (int i = digits < kMostHexDigits ? digits : kMostHexDigits; i-- > 0;)
    text << std::string_view(&"0123456789ABCDEF"[number >> 4 * i & 0xF], 1);
  text << "h";
  return text;
}

}  // namespace tactus::can
