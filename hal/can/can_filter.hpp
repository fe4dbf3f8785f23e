// CanFilter: which identifiers a bus brings to its socket.
#pragma once

#include <cstdint>

namespace tactus::can {

/// Frames to receive: those with `frame.id & mask == id & mask`.
struct CanFilter {
  std::uint16_t id = 0, mask = 0x7FF;
};

}  // namespace tactus::can
