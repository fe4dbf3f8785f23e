// Guard: the last word before the wire. What was measured must be possible, what is sent must be
// finite and is kept within limits: a torque within torque and torque rate, a position or velocity
// within position, velocity and acceleration, braking distance included; and a robot that is sent
// positions must follow. A violation is a Status and stops the robot; limiting is a flag in
// telemetry.
#pragma once

#include <array>
#include <cstdint>

#include "kernel/guard/position_limiter.hpp"
#include "kernel/guard/velocity_limiter.hpp"
#include "kernel/hal.hpp"
#include "kernel/joint_limits.hpp"

namespace tactus {

class Guard {
 public:
  /// The [guard] section. Limits can be tightened below the robot table's, not widened.
  struct Params {
    JointLimits limits;
    JointVector position_margin = JointVector::Zero();  ///< rad, taken off both position limits
    /// Fraction of acceleration and jerk limits that a trajectory leaves free, so that it can be
    /// stopped on its path at any time.
    double stop_reserve = 0.02;
    /// How much longer a trajectory may become by being slowed down where it is beyond a limit, as
    /// a fraction.
    double max_stretch = 0.1;
    /// How far a robot may be from the position it was sent: following_error rad, and
    /// following_time s times its measured speed. 0.1 rad is what the demonstrations of Risi et al.
    /// 2026 allow the real UR10; a servo loop of 0.1 s lags by that time.
    JointVector following_error = JointVector::Constant(0.1);
    JointVector following_time = JointVector::Constant(0.1);
    /// Limiting in more than limiting_share of the cycles of limiting_window s stops the robot: a
    /// law whose every other command is limited is not the law that was meant. 1: never, for a
    /// limit that is to act for long.
    double limiting_share = 0.5;
    double limiting_window = 1.0;

    template <class Visitor>
    void describe(Visitor& visit) {
      visit.limit("max_velocity", limits.dq_max, "rad/s");
      visit.limit("max_acceleration", limits.ddq_max, "rad/s^2");
      visit.limit("max_jerk", limits.dddq_max, "rad/s^3");
      visit.limit("max_velocity_step", limits.velocity_step, "rad/s");
      visit.limit("max_torque", limits.tau_max, "N m");
      visit.limit("max_torque_rate", limits.dtau_max, "N m/s");
      visit.param("stop_reserve", stop_reserve, Range{0.0, 0.9}, "1");
      visit.param("max_stretch", max_stretch, Range{0.0, 10.0}, "1");
      visit.param("position_margin", position_margin, Range{0.0, 0.5}, "rad");
      visit.param("following_error", following_error, kPositive, "rad");
      visit.param("following_time", following_time, kNonNegative, "s");
      visit.param("limiting_share", limiting_share, Range{0.0, 1.0}, "1");
      visit.param("limiting_window", limiting_window, Range{0.01, 60.0}, "s");
    }
    /// The limits with the margin taken off. [init]
    JointLimits effective() const;
  };

  /// Counters since start.
  struct Telemetry {
    bool limited = false;              ///< the last command was
    std::uint32_t limited_cycles = 0;  ///< cycles in which a command was limited
    std::uint32_t limited_joints = 0;  ///< bit i: joint i was limited at least once
    std::uint32_t jerky_cycles = 0;    ///< cycles in which a position or velocity sent took more
                                       ///< than the jerk limit; counted, not limited
    int tripped_joint = -1;            ///< joint of the violation that stopped the robot
    double tripped_value = 0.0, tripped_limit = 0.0;
  };

  /// Takes the limits and begins bumpless for commands of `mode`: at the measured position at rest,
  /// at the measured velocity, or at the torque the actuators hold now; if that is beyond its
  /// limit, no command could keep torque and rate: kEffortLimit. Else as check(). [init]
  Status start(const Params& params, CommandMode mode, const RobotState& state, double period_s);

  /// Measured state: finite, within position and velocity limits, and where positions are
  /// commanded near the last that was sent.
  /// kStateNotFinite, kMeasuredPositionLimit, kMeasuredVelocityLimit, kFollowingError. [cyclic]
  Status check(const RobotState& state);

  /// Command: finite, or kCommandNotFinite; of the mode that was started, or kNotStarted. It is
  /// brought within limits (the file comment says which) but for the allowances of step_band.hpp.
  /// Nothing is sent, and brake() may follow in the same cycle, if it is not kOk.
  /// `state` is what was checked in this cycle. [cyclic]
  Status limit(const RobotState& state, RobotCommand& command);

  /// Instead of a command that cannot be had: brings positions and velocities to rest as fast as
  /// their limits allow, from the last that was sent, and holds them there. Efforts, which nobody
  /// can brake without the chain, go to zero at their rate. [cyclic]
  RobotCommand brake(const RobotState& state);

  const Telemetry& telemetry() const { return telemetry_; }

 private:
  Status trip(Status status, int joint, double value, double limit);
  Status check_following(const RobotState& state);
  double allowed(int joint, double wanted, const RobotState& state);
  double allowed_effort(int joint, double wanted);
  bool jerky(int joint) const;

  JointLimits limits_;
  CommandMode mode_ = CommandMode::kEffort;
  JointVector max_step_ = JointVector::Zero();  // N m per cycle
  JointVector last_ = JointVector::Zero();      // N m
  std::array<PositionLimiter, kDof> positions_;
  std::array<VelocityLimiter, kDof> velocities_;
  JointVector following_error_ = JointVector::Zero(), following_time_ = JointVector::Zero();
  Telemetry telemetry_;
};

}  // namespace tactus
