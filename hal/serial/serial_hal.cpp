#include "hal/serial/serial_hal.hpp"

namespace tactus::serial {

Capabilities SerialHal::capabilities() const {
  Capabilities offered;
  offered.position = offered.velocity = offered.effort = true;
  offered.wrench = offered.velocity_feed_forward = true;
  offered.min_period_us = 100;
  offered.max_period_us = 10000;
  return offered;
}

Status SerialHal::connect(CommandMode mode) {
  state_ = RobotState();
  command_ = RobotCommand();
  command_.mode = mode;
  order_ = Order::kDisabled;
  return Status::kOk;
}

Status SerialHal::read(const CycleTime&, RobotState& state) {
  state = state_;
  return Status::kOk;
}

Status SerialHal::write(const RobotCommand& command) {
  command_ = command;
  return Status::kOk;
}

Status SerialHal::disconnect() {
  command_.request = DriveRequest::kDisable;
  return Status::kOk;
}

void SerialHal::take(ByteReader payload, const CycleTime& now) {
  RobotState state;
  Order order;
  if (!read_state(payload, order, state)) return;
  if (state.stamp_ns < state_.stamp_ns || state.stamp_ns - kAhead_ns > now.stamp_ns) return;
  state_ = state;
  order_ = order;
}

}  // namespace tactus::serial
