// EpochGate: lets the messages of a stream pass in their order. Each has the number of its epoch
// and one in the epoch, and both only grow. A stop voids the epoch: its messages that are still on
// their way are refused, until the client has seen the stop and begins a newer one.
#pragma once

#include <algorithm>
#include <cstdint>

namespace tactus {

class EpochGate {
 public:
  enum class Order : std::uint8_t {
    kNext,  ///< newer than all before
    kOld,   ///< a duplicate, or overtaken
    kVoid,  ///< of an epoch that a stop has ended
  };

  /// Judges a message, and takes one that is newer than all before. [cyclic]
  Order take(std::uint32_t epoch, std::uint32_t sequence) {
    if (epoch < epoch_) return Order::kOld;
    if (epoch < least_) return Order::kVoid;
    if (epoch == epoch_ && taken_ && sequence <= sequence_) return Order::kOld;
    epoch_ = epoch;
    sequence_ = sequence;
    taken_ = true;
    return Order::kNext;
  }
  /// Voids the present epoch, and those up to `seen`. [cyclic]
  void end(std::uint32_t seen = 0) {
    epoch_ = std::max(epoch_, seen);
    least_ = epoch_ + 1;
  }
  /// The least epoch whose messages pass.
  std::uint32_t least() const { return std::max(least_, epoch_); }

 private:
  std::uint32_t epoch_ = 0, sequence_ = 0, least_ = 1;
  bool taken_ = false;
};

}  // namespace tactus
