// Frames written as hexadecimal digits.
#pragma once

#include <cstdlib>
#include <string_view>

#include "hal/ethercat/protocol_frame.hpp"

namespace tactus::ethercat {

inline constexpr std::uint8_t kSender[6] = {0x02, 0, 0, 0, 0, 0x01};

inline Frame frame_of(std::string_view digits) {
  Frame frame;
  for (frame.size = 0; 2 * frame.size + 1 < digits.size(); ++frame.size) {
    const char pair[] = {digits[2 * frame.size], digits[2 * frame.size + 1], '\0'};
    frame.bytes[frame.size] = static_cast<std::uint8_t>(std::strtoul(pair, nullptr, 16));
  }
  return frame;
}

}  // namespace tactus::ethercat
