// PID control with feed-forward, each joint for itself.
//
//   tau = Kp e + Kd (dq_d - dq) + Ki integral(e) + feed-forward + g(q)      e = q_d - q
//                                                                     [Risi et al. 2026, eq. 3]
//   feed-forward = Fv dq_d + Fa ddq_d + Ft tau_d
//
// What is integrated is Ki e, in N m, by the trapezoidal rule: exact for an error that is straight
// between samples, and a change of Ki steps nothing. A velocity that is not wired is the difference
// of the position. The rate of the error is low-passed with the pole of the continuous filter,
// exp(-dt/T); the filter is exact for a rate that is constant over the past period, so at every
// period the response is that of the continuous one to within half a period times the slope of the
// rate.
//
// Anti-windup [Astrom and Hagglund, Advanced PID Control, 2006, section 3.5]:
//   back_calculation   what the output limit takes off drives the integral back with a time
//                      constant
//   conditional        the integral does not grow where it would push the torque beyond the limit
//
// Braked, the integral is frozen.
#pragma once

#include "kernel/brake.hpp"
#include "kernel/describe.hpp"
#include "kernel/joint_limits.hpp"
#include "kernel/port.hpp"
#include "kernel/status.hpp"

namespace tactus {

class Pid {
 public:
  static constexpr const char* kType = "pid";

  enum class Derivative : std::uint8_t { kError, kMeasurement };
  enum class AntiWindup : std::uint8_t { kNone, kBackCalculation, kConditional };
  static constexpr std::array<const char*, 2> kDerivativeWords = {"error", "measurement"};
  static constexpr std::array<const char*, 3> kAntiWindupWords = {"none", "back_calculation",
                                                                  "conditional"};
  struct Gains {
    JointVector kp = JointVector::Constant(kRequired);  ///< N m/rad
    JointVector ki = JointVector::Constant(kRequired);  ///< N m/(rad s); 0: no integral
    JointVector kd = JointVector::Constant(kRequired);  ///< N m s/rad
  };

  struct Params {
    Gains gains;
    JointVector dead_band = JointVector::Zero();  ///< rad; taken off the error on either side of 0
    Derivative derivative = Derivative::kError;   ///< on measurement: dq_d is left out
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
  In<Quantity::kJointEffort> tau_measured;  ///< read at start only: the torque to begin with
  Out<Quantity::kJointEffort> tau;

  template <class Visitor>
  void describe(Visitor& visit) {
    visit.param("kp", params.gains.kp, kNonNegative, "N m/rad");
    visit.param("ki", params.gains.ki, kNonNegative, "N m/(rad s)");
    visit.param("kd", params.gains.kd, kNonNegative, "N m s/rad");
    visit.param("dead_band", params.dead_band, kNonNegative, "rad");
    visit.choice("derivative", params.derivative, kDerivativeWords);
    visit.param("derivative_time_constant", params.derivative_time_constant, kNonNegative, "s");
    visit.choice("anti_windup", params.anti_windup, kAntiWindupWords);
    visit.param("tracking_time_constant", params.tracking_time_constant, kNonNegative, "s");
    visit.limit("integral_limit", params.integral_limit, "N m");
    visit.limit("output_limit", params.output_limit, "N m");
    visit.param("velocity_gain", params.velocity_gain, kNonNegative, "N m s/rad");
    visit.param("acceleration_gain", params.acceleration_gain, kNonNegative, "kg m^2");
    visit.param("effort_gain", params.effort_gain, kNonNegative, "1");
    visit.in("q_d", q_d), visit.in("q", q), visit.optional("dq_d", dq_d), visit.optional("dq", dq);
    visit.optional("ddq_d", ddq_d), visit.optional("tau_d", tau_d), visit.optional("g", g);
    visit.optional("tau_measured", tau_measured);
    visit.out("tau", tau);
  }

  /// The integral begins at zero: with the reference at the measured position and the robot at rest
  /// the first torque is gravity and feed-forward. With tau_measured wired it begins so that the
  /// first torque is the one measured, at joints with ki > 0 and as far as its limit goes.
  /// kNotConnected: a feed-forward gain without its input. Else as step(). [init]
  Status start();

  /// kCommandNotFinite if an input that is read is not finite; torque and state then stay as they
  /// are. [cyclic]
  Status step(double dt_s);

  /// The integral stays as it is until the next start: an arm that is held, or meets something
  /// while it brakes, winds nothing up. [cyclic]
  void brake(Status /*why*/, BrakeWay /*way*/) { frozen_ = true; }

  /// Changes the gains and moves the integral by what the other terms of the last cycle change, so
  /// that the torque does not step. What is beyond the integral's limit steps, and at a joint whose
  /// new ki is 0 all of it, at most |new kp - old kp| |e| + |new kd - old kd| |rate of e|; the
  /// integral it has stays as it is. kBadValue, and nothing changes, if a gain is negative or not
  /// finite. [cyclic], after a step
  Status set_gains(const Gains& gains);

  /// The integral term, N m. [any]
  const JointVector& integral() const { return integral_; }

 private:
  JointVector error() const;
  JointVector error_rate(double dt_s) const;
  JointVector filtered(const JointVector& rate, double dt_s) const;
  JointVector other_terms(const JointVector& e, const JointVector& de) const;
  double integrated(int i, double e, double others, double dt_s) const;
  double tracking_time_constant(int i) const;
  Status put_out(const JointVector& e, const JointVector& de, const JointVector& integral);

  // Of the last cycle.
  JointVector e_ = JointVector::Zero(), de_ = JointVector::Zero();
  JointVector q_ = JointVector::Zero(), q_d_ = JointVector::Zero();
  JointVector integral_ = JointVector::Zero();  // N m
  bool frozen_ = false;
};

}  // namespace tactus
