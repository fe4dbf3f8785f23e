// Frames on the link: written whole, read byte by byte. A reader finds the next frame behind any
// bytes whatever: a frame ends with the only zero.
#pragma once

#include <array>

#include "hal/serial/protocol.hpp"

namespace tactus::serial {

struct Frame {
  Kind kind = Kind::kAnswer;
  std::uint16_t number = 0;
  const std::uint8_t* payload = nullptr;  ///< `size` bytes, valid until the next one is read
  std::size_t size = 0;
};

/// Writes a frame of at most kMaxPayload bytes to `out`, which holds kMaxFrame; returns its length,
/// 0 if the payload is too long. [any]
std::size_t write_frame(const Frame& frame, std::uint8_t* out);

/// Counters of received frames and of bytes that were none, since the start.
struct LinkHealth {
  std::uint32_t frames = 0;     ///< whole ones
  std::uint32_t corrupted = 0;  ///< with another check sum
  std::uint32_t malformed = 0;  ///< too short, too long, or not COBS
};

class FrameReader {
 public:
  /// Takes one byte. True: it ended a frame; frame() is that. [cyclic]
  bool take(std::uint8_t byte);
  const Frame& frame() const { return frame_; }
  const LinkHealth& health() const { return health_; }
  /// Forgets a frame that has begun. [any]
  void clear() { size_ = 0; }

 private:
  bool finish();
  bool unstuff();

  std::array<std::uint8_t, kMaxFrame> bytes_;
  std::size_t size_ = 0;  // of bytes_; beyond its end: the frame is too long
  Frame frame_;
  LinkHealth health_;
};

}  // namespace tactus::serial
