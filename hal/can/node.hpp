// Node: one drive on its bus, as its messages show it; and the frames that wait to be sent.
#pragma once

#include <array>
#include <cstdint>

#include "hal/can/heartbeat_watch.hpp"
#include "hal/can/pdo_layout.hpp"
#include "hal/can/protocol_canopen.hpp"
#include "hal/cia402/drive_wire.hpp"
#include "kernel/core/load_error.hpp"

namespace tactus::can {

inline constexpr int kMaxBuses = 4;

struct Node {
  int bus = 0;  ///< from 0
  Slot slot;
  HeartbeatWatch heart;
  int frames = 0;      ///< of feedback since the last cycle
  int unanswered = 0;  ///< SYNCs whose feedback may still come
  int surplus = 0;     ///< cycles in a row with more feedback than SYNCs
  cia402::DriveFeedback feedback;

  std::uint8_t id() const { return slot.node; }
};
using Nodes = std::array<Node, kDof>;

/// Frames that wait to be sent on one bus.
class Outbox {
 public:
  static constexpr int kCapacity = 3 * kDof + 3;  ///< two RPDOs and one request each, and the rest

  void add(const CanFrame& frame) {
    if (count_ < kCapacity) frames_[static_cast<std::size_t>(count_++)] = frame;
  }
  const CanFrame* frames() const { return frames_.data(); }
  int count() const { return count_; }
  void clear() { count_ = 0; }

 private:
  std::array<CanFrame, kCapacity> frames_;
  int count_ = 0;
};
using Outboxes = std::array<Outbox, kMaxBuses>;

/// "joint 3 (node 3)": how messages name a drive. [any]
inline Message label(int joint, const Node& node) {
  Message text("joint ");
  text << joint + 1 << " (node " << static_cast<int>(node.id()) << ")";
  return text;
}

}  // namespace tactus::can
