// Hal: the one seam to the outside world. Four functions, SI units, and a statement of what the
// robot offers.
#pragma once

#include <cstdint>

#include "kernel/status.hpp"
#include "kernel/types.hpp"

namespace tactus {

/// What the drives take. A pipeline commands exactly one of these.
enum class CommandMode : std::uint8_t { kPosition, kVelocity, kEffort };

/// What was measured at the start of a cycle.
struct RobotState {
  JointVector q = JointVector::Zero();    ///< rad
  JointVector dq = JointVector::Zero();   ///< rad/s
  JointVector tau = JointVector::Zero();  ///< N m, what the actuators exert
  Vector6 ft = Vector6::Zero();  ///< N, N m: what environment and tool exert on a sensor at the
                                 ///< flange, at its origin and in its axes; zero without a sensor
  double speed_scaling = 1.0;    ///< how fast the robot lets motions pass: 0 standing, 1 as sent
};

/// What is sent at the end of a cycle: rad, rad/s or N m, as the mode says.
struct RobotCommand {
  CommandMode mode = CommandMode::kEffort;
  JointVector value = JointVector::Zero();
};

/// What a robot and its wire can do; compared with the pipeline file before anything starts.
struct Capabilities {
  bool position = false, velocity = false, effort = false;  ///< command modes it takes
  std::int64_t min_period_us = 0, max_period_us = 0;        ///< cycle periods it can serve
  bool wrench = false;  ///< it has a force/torque sensor at the flange
};

class Hal {
 public:
  /// States what this robot and wire can do. [any]
  virtual Capabilities capabilities() const = 0;
  /// Connects, enables the drives in `mode` and reports the state they hold: attaching moves
  /// nothing. [init]
  virtual Status start(CommandMode mode, RobotState& state) = 0;
  /// The newest measured state. Bounded, never blocks. [cyclic]
  virtual Status read(RobotState& state) = 0;
  /// Sends one command. Bounded, never blocks. [cyclic]
  virtual Status write(const RobotCommand& command) = 0;
  /// Brings the robot to a standstill and disables the drives; may be called in any state, more
  /// than once. [any]
  virtual void stop() = 0;

 protected:
  ~Hal() = default;  // owned by the board as a static object, never deleted through the interface
};

}  // namespace tactus
