// Guard: the last word before the wire. What was measured must be possible, what is sent must be
// finite and is kept within torque and torque-rate limits. A violation is a Status and stops the
// robot; limiting is a flag in telemetry.
#pragma once

#include <cstdint>

#include "kernel/hal.hpp"
#include "kernel/joint_limits.hpp"

namespace tactus {

class Guard {
 public:
  /// The [guard] section. Limits can be tightened below the robot table's, not widened.
  struct Params {
    JointLimits limits;
    JointVector position_margin = JointVector::Zero();  ///< rad, taken off both position limits
    /// Fraction of acceleration and jerk limits that a trajectory must leave free, so that it can
    /// be stopped on its path at any time.
    double stop_reserve = 0.1;

    template <class Visitor>
    void describe(Visitor& visit) {
      visit.limit("max_velocity", limits.dq_max, "rad/s");
      visit.limit("max_acceleration", limits.ddq_max, "rad/s^2");
      visit.limit("max_jerk", limits.dddq_max, "rad/s^3");
      visit.limit("max_velocity_step", limits.velocity_step, "rad/s");
      visit.limit("max_torque", limits.tau_max, "N m");
      visit.limit("max_torque_rate", limits.dtau_max, "N m/s");
      visit.param("stop_reserve", stop_reserve, Range{0.01, 0.9}, "1");
      visit.param("position_margin", position_margin, Range{0.0, 0.5}, "rad");
    }
    /// The limits with the margin taken off. [init]
    JointLimits effective() const;
  };

  /// Counters since start.
  struct Telemetry {
    std::uint32_t limited_cycles = 0;  ///< cycles in which a command was limited
    std::uint32_t limited_joints = 0;  ///< bit i: joint i was limited at least once
    int tripped_joint = -1;            ///< joint of the violation that stopped the robot
    double tripped_value = 0.0, tripped_limit = 0.0;
  };

  /// Takes the limits and the torque the actuators hold now, from which the rate is counted; if
  /// that is beyond its limit, no command could keep both limits: kEffortLimit. Else as check().
  /// [init]
  Status start(const Params& params, const RobotState& state, double period_s);

  /// Measured state: finite, within position and velocity limits.
  /// kStateNotFinite, kMeasuredPositionLimit, kMeasuredVelocityLimit. [cyclic]
  Status check(const RobotState& state);

  /// Command: finite, or kCommandNotFinite. An effort is clamped to torque and torque-rate limits.
  /// [cyclic]
  Status limit(RobotCommand& command);

  const Telemetry& telemetry() const { return telemetry_; }

 private:
  Status trip(Status status, int joint, double value, double limit);

  JointLimits limits_;
  JointVector max_step_ = JointVector::Zero();  // N m per cycle
  JointVector last_ = JointVector::Zero();      // N m
  Telemetry telemetry_;
};

}  // namespace tactus
