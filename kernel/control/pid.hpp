// PID control with feed-forward, separately for each joint.
//
//   tau = Kp e + Kd (dq_d - dq) + Ki integral(e) + feed-forward + g(q)      e = q_d - q
//                                                                     [Risi et al. 2026, eq. 3]
//   feed-forward = Fv dq_d + Fa ddq_d + Ft tau_d
//
// The integral is that of Ki e, in N m, by the trapezoidal rule: exact for an error that is linear
// between samples, and a change of Ki causes no step. When another gain changes, the difference
// fades (kernel/math/bumpless_transfer.hpp). A velocity that is not wired is the
// difference of the position. The rate of the error is low-passed with the pole of the continuous
// filter, exp(-dt/T); the filter is exact for a rate that is constant over the past period, so at
// every period the response is that of the continuous one to within half a period times the slope
// of the rate.
//
// Anti-windup [Astrom and Hagglund, Advanced PID Control, 2006, section 3.5]:
//   back_calculation   the excess over the output limit drives the integral back with a time
//   constant conditional        the integral does not grow if that would push the torque beyond the
//   limit
//
// When braked, the integral is frozen.
#pragma once

#include "kernel/core/brake.hpp"
#include "kernel/core/describe.hpp"
#include "kernel/core/joint_limits.hpp"
#include "kernel/core/port.hpp"
#include "kernel/core/status.hpp"
#include "kernel/math/bumpless_transfer.hpp"

namespace tactus {

enum class Derivative : std::uint8_t { kError, kMeasurement };

constexpr const char* name(Derivative derivative) {
  switch (derivative) {
    case Derivative::kError: return "error";
    case Derivative::kMeasurement: return "measurement";
  }
  return nullptr;
}

enum class AntiWindup : std::uint8_t { kNone, kBackCalculation, kConditional };

constexpr const char* name(AntiWindup anti_windup) {
  switch (anti_windup) {
    case AntiWindup::kNone: return "none";
    case AntiWindup::kBackCalculation: return "back_calculation";
    case AntiWindup::kConditional: return "conditional";
  }
  return nullptr;
}

class Pid {
 public:
  static constexpr const char* kType = "pid";

  struct Gains {
    JointVector kp = JointVector::Constant(kRequired);  ///< N m/rad
    JointVector ki = JointVector::Constant(kRequired);  ///< N m/(rad s); 0: no integral
    JointVector kd = JointVector::Constant(kRequired);  ///< N m s/rad
  };

  struct Params {
    Gains gains;
    JointVector dead_band = JointVector::Zero();  ///< rad; shortens the error on both sides of 0
    Derivative derivative = Derivative::kError;   ///< on measurement: without dq_d
    JointVector derivative_time_constant = JointVector::Zero();  ///< s; 0: no filter

    AntiWindup anti_windup = AntiWindup::kConditional;
    /// s, of back_calculation; 0: sqrt(kd/ki), or kp/ki without kd; with ki alone: at once
    JointVector tracking_time_constant = JointVector::Zero();
    JointVector integral_limit = JointLimits().tau_max;  ///< N m, of the integral term
    JointVector output_limit = JointLimits().tau_max;    ///< N m, of the sum of all terms

    JointVector velocity_gain = JointVector::Zero();      ///< Fv, N m s/rad
    JointVector acceleration_gain = JointVector::Zero();  ///< Fa, kg m^2
    JointVector effort_gain = JointVector::Ones();        ///< Ft
  } params;

  In<Quantity::kJointPosition> q_d, q;
  In<Quantity::kJointVelocity> dq_d, dq;  ///< not wired: the difference of the position
  In<Quantity::kJointAcceleration> ddq_d;
  In<Quantity::kJointEffort> tau_d;
  In<Quantity::kJointEffort> g;             ///< gravity torque
  In<Quantity::kJointEffort> tau_measured;  ///< read at start() only: the initial torque
  Out<Quantity::kJointEffort> tau;

  template <class Visitor>
  void describe(Visitor& visit) {
    visit.tunable("kp", params.gains.kp, kNonNegative, "N m/rad");
    visit.tunable("ki", params.gains.ki, kNonNegative, "N m/(rad s)");
    visit.tunable("kd", params.gains.kd, kNonNegative, "N m s/rad");
    visit.tunable("dead_band", params.dead_band, kNonNegative, "rad");
    visit.choice("derivative", params.derivative);
    visit.param("derivative_time_constant", params.derivative_time_constant, kNonNegative, "s");
    visit.choice("anti_windup", params.anti_windup);
    visit.tunable("tracking_time_constant", params.tracking_time_constant, kNonNegative, "s");
    visit.limit("integral_limit", params.integral_limit, "N m");
    visit.limit("output_limit", params.output_limit, "N m");
    visit.tunable("velocity_gain", params.velocity_gain, kNonNegative, "N m s/rad");
    visit.tunable("acceleration_gain", params.acceleration_gain, kNonNegative, "kg m^2");
    visit.tunable("effort_gain", params.effort_gain, kNonNegative, "1");
    visit.in("q_d", q_d);
    visit.in("q", q);
    visit.optional("dq_d", dq_d);
    visit.optional("dq", dq);
    visit.optional("ddq_d", ddq_d);
    visit.optional("tau_d", tau_d);
    visit.optional("g", g);
    visit.optional("tau_measured", tau_measured);
    visit.out("tau", tau);
  }

  /// The integral begins at zero: if the reference is at the measured position and the robot at
  /// rest, the first torque is gravity and feed-forward. If tau_measured is wired, the integral
  /// begins such that the first torque is the measured one, at joints with ki > 0 and within its
  /// limit. Returns what judge() does; otherwise as step(). [init]
  [[gnu::cold]] Status start();
  /// Returns kNotConnected if a feed-forward gain lacks its input. [init]
  [[gnu::cold]] Status judge() const;

  /// Returns kCommandNotFinite if an input that is read is not finite; torque and state are then
  /// unchanged. [cyclic]
  Status step(double dt_s);

  /// Freezes the integral until the next start(): an arm that is held, or meets something while it
  /// brakes, does not wind it up. [cyclic]
  void brake(Status /*why*/, BrakeWay /*way*/) { frozen_ = true; }
  /// Lets the integral move on from its present value. [init]
  Status resume() {
    frozen_ = false;
    return Status::kOk;
  }

  /// Judges a change of the parameters as judge_torque(), before the output limit.
  /// [between two cycles], after a step
  Verdict judge_change(const Params& next, const JointLimits& limits) const;
  /// Changes the tunable parameters. The integral keeps its torque, also where the new ki is 0; the
  /// torque continues from the last one, and the difference fades with at most half of
  /// limits.dtau_max. [between two cycles], after a step
  void retune(const Params& next, const JointLimits& limits);

  /// The integral term, N m. [any]
  const JointVector& integral() const { return integral_; }

 private:
  JointVector error(const JointVector& dead_band) const;
  JointVector error_rate(double dt_s) const;
  JointVector filtered(const JointVector& rate, double dt_s) const;
  JointVector other_terms(const Params& with, const JointVector& e, const JointVector& de) const;
  JointVector torque(const Params& with) const;
  double integrated(int i, double e, double others, double dt_s) const;
  double tracking_time_constant(int i) const;
  Status emit(const JointVector& e, const JointVector& de, const JointVector& integral);

  // Values of the last cycle.
  JointVector e_ = JointVector::Zero(), de_ = JointVector::Zero();
  JointVector q_ = JointVector::Zero(), q_d_ = JointVector::Zero();
  JointVector integral_ = JointVector::Zero();  // N m
  bool frozen_ = false;
  BumplessTransfer<JointVector> transfer_;
};

}  // namespace tactus
