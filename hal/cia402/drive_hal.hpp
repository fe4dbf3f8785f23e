// Common parts of the Hals of CiA 402 drives on any bus: their capabilities, and the release of the
// drives. Frames, cycles and their clock belong to the bus.
#pragma once

#include "hal/cia402/hex.hpp"
#include "hal/cia402/protocol_errors.hpp"
#include "kernel/core/hal.hpp"

namespace tactus::cia402 {

/// Positions, velocities with a torque and torques; 0.5 to 20 ms. [any]
inline Capabilities capabilities_of_drives() {
  Capabilities offered;
  offered.position = offered.velocity = offered.effort = true;
  offered.velocity_feed_forward = offered.effort_feed_forward = true;
  offered.min_period_us = 500;
  offered.max_period_us = 20000;
  return offered;
}

/// "error code 7305h, encoder 1". [any]
inline Message text_of_code(std::uint32_t code) {
  Message text("error code ");
  text << hex(code) << ", " << error_text(static_cast<std::uint16_t>(code));
  return text;
}

/// Runs the exchange of a cycle in which the drives are requested to be disabled. [any]
inline void exchange_stop(Hal& hal, const CycleTime& now, CommandMode mode) {
  RobotState state;
  RobotCommand stop;
  stop.mode = mode;
  (void)hal.read(now, state);
  (void)hal.write(stop);
}

/// The longest time to wait for drives to confirm that they are disabled: that of the longest quick
/// stop, and cycles to see its end. [any]
constexpr std::int64_t longest_leaving_ns(int stop_ms, int period_us) {
  constexpr int kLater = 20;  // cycles
  return std::int64_t{1'000'000} * stop_ms + std::int64_t{1000} * period_us * kLater;
}

/// True if `awaits(joint)` is of any joint, from 0. [any]
template <class Awaits>
bool any_joint(Awaits awaits) {
  for (int j = 0; j < kDof; ++j)
    if (awaits(j)) return true;
  return false;
}

/// kBusTimeout: `left` names the joints whose drives may have power. Where nobody was waited for,
/// no time is named. [any]
template <class Master>
Status judge_stop(const Master& master, std::int64_t waited_ns, Message& left) {
  for (int j = 0; j < kDof; ++j)
    if (!master.confirmed(j)) left << (left.empty() ? "" : ", ") << master.label(j);
  if (left.empty()) return Status::kOk;
  left << ": no statusword has confirmed";
  const auto waited_ms = static_cast<int>(waited_ns / 1'000'000);
  if (waited_ms > 0) left << " within " << waited_ms << " ms";
  left << " that the drive is disabled; its motor may have power: cut it by the emergency stop,"
          " then check power and cabling of the drive";
  return Status::kBusTimeout;
}

}  // namespace tactus::cia402
