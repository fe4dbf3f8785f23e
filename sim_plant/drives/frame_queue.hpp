// FrameQueue: the frames that wait to be sent on one bus, in fixed memory.
#pragma once

#include <array>

#include "hal/can/protocol_frame.hpp"

namespace tactus::drives {

class FrameQueue {
 public:
  static constexpr std::size_t kSize = 512;

  /// Adds a frame; when the queue is full it is lost, and counted. [any]
  void push(const can::CanFrame& frame) {
    if (count_ == kSize) {
      ++lost_;
      return;
    }
    frames_[(first_ + count_++) % kSize] = frame;
  }
  /// Takes the oldest frame; false: there is none. [any]
  bool take(can::CanFrame& frame) {
    if (count_ == 0) return false;
    frame = frames_[first_];
    first_ = (first_ + 1) % kSize;
    --count_;
    return true;
  }
  void clear() { count_ = 0; }
  std::uint64_t lost() const { return lost_; }

 private:
  std::array<can::CanFrame, kSize> frames_{};
  std::size_t first_ = 0, count_ = 0;
  std::uint64_t lost_ = 0;
};

}  // namespace tactus::drives
