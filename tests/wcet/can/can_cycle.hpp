// The CAN part of a cycle as CanHal runs it, without its system calls: what has come on the buses
// is received and judged, and the frames of this cycle are made.
#pragma once

#include "hal/can/can_master.hpp"

namespace tactus::can {

/// What has come on the buses since the last cycle: at most a batch of CanSocket on each.
struct Arrived {
  static constexpr int kMost = 64;

  std::array<std::array<CanFrame, kMost>, kMaxBuses> frames;
  std::array<int, kMaxBuses> count{};

  void clear() { count.fill(0); }
  /// Adds a frame of a bus; false: it waits for the next cycle. [any]
  bool add(std::size_t bus, const CanFrame& frame) {
    if (count[bus] == kMost) return false;
    frames[bus][static_cast<std::size_t>(count[bus]++)] = frame;
    return true;
  }
};

/// Never inlined, so that it can be counted and bounded. [cyclic]
Status can_cycle(CanMaster& master, const Arrived& arrived, const CycleTime& now,
                 const RobotCommand& command, RobotState& state);

}  // namespace tactus::can
