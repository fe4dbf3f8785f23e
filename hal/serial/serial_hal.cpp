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

bool SerialHal::take(ByteReader payload) {
  RobotState state;
  Order order;
  if (!read_state(payload, order, state) || state.stamp_ns < state_.stamp_ns) return false;
  state_ = state;
  order_ = order;
  return true;
}

}  // namespace tactus::serial
