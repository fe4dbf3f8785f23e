// SerialHal: a robot at the other end of a link: its states arrive in frames, and every cycle
// answers with a command. The board's loop takes the frames off the link and sends what the cycle
// gave.
#pragma once

#include "hal/serial/cycle_frames.hpp"

namespace tactus::serial {

class SerialHal final : public Hal {
 public:
  static constexpr std::int64_t kAhead_ns = 10'000'000;  ///< most by which a state may be

  /// Capabilities of the plant; the computer checks that it is the robot of the pipeline. [any]
  Capabilities capabilities() const override;
  /// Discards earlier states; the link belongs to the board. [init]
  Status connect(CommandMode mode) override;
  /// Repeats the newest state. Before the first one all drives are kUnknown. [cyclic]
  Status read(const CycleTime& now, RobotState& state) override;
  /// Keeps the command for the board's loop. [cyclic]
  Status write(const RobotCommand& command) override;
  /// The command is to disable the drives, from now on. [any]
  Status disconnect() override;

  /// Takes the payload of a kState, unless it is malformed, older than the last, or so far ahead
  /// of the cycle that it would make all others old. [cyclic]
  void take(ByteReader payload, const CycleTime& now);
  /// The order of the newest state. [any]
  Order order() const { return order_; }
  /// The command of the last cycle. [cyclic]
  const RobotCommand& command() const { return command_; }

 private:
  RobotState state_;
  RobotCommand command_;
  Order order_ = Order::kDisabled;
};

}  // namespace tactus::serial
