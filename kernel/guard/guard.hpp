// Guard: the last check before the wire. The measured state must be young and possible. A command
// must be finite and is kept within limits: a torque within torque and torque rate, a position or
// velocity within position, velocity and acceleration, braking distance included. A feed-forward
// beside it is kept within velocity and acceleration, or torque and torque rate; where a position
// is limited, its feed-forward is no faster than what is sent. A robot that is sent positions or
// velocities must follow them. A violation is a Status and stops the robot; limiting is a flag in
// telemetry.
#pragma once

#include <array>
#include <cstdint>

#include "kernel/core/hal.hpp"
#include "kernel/core/joint_limits.hpp"
#include "kernel/guard/position_limiter.hpp"
#include "kernel/guard/slew_limiter.hpp"
#include "kernel/guard/velocity_limiter.hpp"

namespace tactus {

class Guard {
 public:
  /// How far beyond a limit a measured position, rad, and velocity, as a fraction, may be.
  static constexpr double kPositionTolerance = 0.01, kVelocityTolerance = 0.1;
  /// How far beyond a position limit an arm may start, to be led back inside, rad.
  static constexpr double kLedBack = 0.1;

  /// The [guard] section. Limits can be tightened below the robot table's, not widened.
  struct Params {
    JointLimits limits;
    JointVector position_margin = JointVector::Zero();  ///< rad, taken off both position limits
    /// The error of the loop: how far a measured position, rad, and velocity, as a fraction of its
    /// limit, may be beyond what references may reach exactly, by the overshoot of a servo or a law
    /// and by noise. The measured may be beyond a limit by the robot's tolerance at most; what the
    /// allowance is larger than that, references keep away from the limit: see references().
    JointVector position_allowance = JointVector::Constant(kPositionTolerance);
    JointVector velocity_allowance = JointVector::Constant(kVelocityTolerance);
    /// Fraction of the acceleration and jerk limits that a trajectory leaves unused, so that it can
    /// be stopped on its path at any time.
    double stop_reserve = 0.02;
    /// Fraction by which a trajectory may become longer when it is slowed down where it exceeds a
    /// limit.
    double max_stretch = 0.1;
    /// Largest distance of a robot from the position it was sent: following_error rad plus
    /// following_time s times its measured speed. 0.1 rad is what the demonstrations of Risi et al.
    /// 2026 allow the real UR10; a servo loop of 0.1 s lags by that time.
    JointVector following_error = JointVector::Constant(0.1);
    JointVector following_time = JointVector::Constant(0.1);
    /// Periods after which a measured state is too old, half a period of jitter not counted. A wire
    /// that repeats the last state when a packet is lost is bridged for so long.
    int max_age = 5;
    /// Limiting in more than limiting_share of the cycles of limiting_window s stops the robot: a
    /// law of which every other command is limited is not the intended law. 1: never stops it, for
    /// a limit that may act for long.
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
      visit.param("position_allowance", position_allowance, Range{1e-6, 0.5}, "rad");
      visit.param("velocity_allowance", velocity_allowance, Range{1e-6, 1.0}, "1");
      visit.param("following_error", following_error, kPositive, "rad");
      visit.param("following_time", following_time, kNonNegative, "s");
      visit.param("max_age", max_age, Range{0.0, 1000.0}, "cycles");
      visit.param("limiting_share", limiting_share, Range{0.0, 1.0}, "1");
      visit.param("limiting_window", limiting_window, Range{0.01, 60.0}, "s");
    }
    /// Returns the limits reduced by the margin. [init]
    [[gnu::cold]] JointLimits effective() const;
    /// Returns the limits of references: effective() less what the allowances exceed the robot's
    /// tolerance by. [init]
    [[gnu::cold]] JointLimits references() const;
  };

  /// Counters since start.
  struct Telemetry {
    bool limited = false;              ///< the last command was limited
    std::uint32_t limited_cycles = 0;  ///< cycles in which a command was limited
    std::uint32_t limited_joints = 0;  ///< bit i: joint i was limited at least once
    std::uint32_t jerky_cycles = 0;    ///< cycles in which a position or velocity sent exceeded the
                                       ///< jerk limit; counted, not limited
    std::uint32_t feed_forward_cycles = 0;  ///< cycles in which a feed-forward was limited
    int tripped_joint = -1;                 ///< joint of the violation that stopped the robot
    double tripped_value = 0.0, tripped_limit = 0.0;
  };

  /// Takes the limits and starts bumpless for commands of `mode`: at rest at the measured position,
  /// at the measured velocity, or at the torque the actuators exert; feed-forward starts at zero.
  /// Returns kEffortLimit if that torque is beyond its limit, where no command could keep both
  /// torque and rate; otherwise as check(). [init]
  [[gnu::cold]] Status start(const Params& params, CommandMode mode, const RobotState& state,
                             double period_s, const CycleTime& now);

  /// Checks that the measured state is young, measured at every joint, finite, within position and
  /// velocity limits and their allowances and, if positions or velocities are commanded, near what
  /// was sent. An arm that starts up to kLedBack beyond a position limit may go back inside, with
  /// the allowance as its play. Returns kStateStale, kStateInvalid, kStateNotFinite,
  /// kMeasuredPositionLimit, kMeasuredVelocityLimit or kFollowingError. [cyclic]
  Status check(const RobotState& state, const CycleTime& now);

  /// Brings a command within the limits named in the file comment, but for the allowances of
  /// step_band.hpp. Returns kCommandNotFinite, or kNotStarted for a mode that was not started; then
  /// nothing is sent, and brake() may follow in the same cycle. While the arm is `braked`, a
  /// position or velocity that cannot be followed is not caught up with: from then on the command
  /// is that of brake(). `state` is the one checked in this cycle. [cyclic]
  Status limit(const RobotState& state, RobotCommand& command, bool braked = false);

  /// Returns the command for a cycle without one from the chain: positions and velocities come to
  /// rest from the last ones sent, as fast as their limits allow, and stay there. A velocity that
  /// was fed forward goes to zero with the acceleration limit; a torque that was stays, because it
  /// may carry a load. Efforts cannot brake without the chain; they go to zero at their rate limit.
  /// [cyclic]
  RobotCommand brake(const RobotState& state);

  /// True if the arm was braked from a command that could not be followed. [between two cycles]
  bool left_behind() const { return left_behind_; }
  /// Returns a measured state at rest with the positions that were sent last, if positions are
  /// sent: from there a chain continues without a step. [between two cycles]
  RobotState held(RobotState measured) const;

  const Telemetry& telemetry() const { return telemetry_; }

 private:
  static constexpr double kFading_s = 1.0;  // so that small errors of a velocity do not add up

  Status trip(Status status, int joint, double value, double limit);
  Status check_age(const RobotState& state, const CycleTime& now);
  Status check_joint(int joint, const RobotState& state);
  double beyond(int joint, double q) const;
  Status check_following(const RobotState& state);
  double allowed(int joint, double wanted, const RobotState& state);
  bool limit_feed_forward(int joint, bool limited, RobotCommand& command);
  bool follows(const JointVector& wanted, const RobotState& state) const;
  bool jerky(int joint) const;

  JointLimits limits_;
  JointVector dq_max_ = JointVector::Zero();     // of what is measured, rad/s
  JointVector allowance_ = JointVector::Zero();  // of a measured position, rad
  JointVector outside_ = JointVector::Zero();    // how far it may still be outside, rad
  CommandMode mode_ = CommandMode::kEffort;
  std::array<PositionLimiter, kDof> positions_;
  std::array<VelocityLimiter, kDof> velocities_;
  std::array<SlewLimiter, kDof> torques_;         // commanded or fed forward
  std::array<SlewLimiter, kDof> fed_velocities_;  // beside positions
  double period_s_ = 0.0;
  int max_age_ = 0;
  JointVector lag_ = JointVector::Zero();  // rad, behind the velocities sent; fades with kFading_s
  JointVector following_error_ = JointVector::Zero(), following_time_ = JointVector::Zero();
  bool left_behind_ = false;  // while braked: the command could not be followed
  Telemetry telemetry_;
};

}  // namespace tactus
