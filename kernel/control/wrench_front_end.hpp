// From what a force/torque sensor at the flange measures to what the environment exerts on the
// tool, at its tip, in base axes.
//
//   ft = [f; m] = bias + [m_t g; c x m_t g] + contact        at the flange, in its axes
//
// m_t and c are the tool's mass and centre of mass, g = 9.81 m/s^2 downwards in the base, turned
// into the flange's axes. The tool's inertial force is not modelled: m_t times its acceleration
// passes as contact. Then, with p the tip in the flange frame and R the flange in the base,
//
//   f_tip = R f_contact,   m_tip = R (m_contact - p x f_contact)
//
// a low-pass y' = (u - y) / time_constant_s, exact for an input held for a period, and a dead band
// that takes `dead_force` off |f|, `dead_moment` off |m|, so that nothing jumps at its edge.
//
// Tare: from start() on, h is zero until ft less the tool's weight has stayed within the tare
// tolerances, largest less smallest on each axis, for tare_s without a break; its mean over that
// interval is the bias. A break begins the interval anew. The robot stands meanwhile and touches
// nothing: a contact that is steady becomes part of the bias. The filter then starts from zero:
// with a time constant, h does not step; without, it steps by what the tare tolerances allow.
#pragma once

#include "kernel/brake.hpp"
#include "kernel/describe.hpp"
#include "kernel/port.hpp"
#include "kernel/status.hpp"

namespace tactus {

class WrenchFrontEnd {
 public:
  static constexpr const char* kType = "wrench_front_end";

  struct Params {
    double max_force = kRequired;        ///< N, range of the sensor: of |f| as measured
    double max_moment = kRequired;       ///< N m, of |m|
    double stuck_s = 0.0;                ///< s; longer than its sample time; 0 = not watched
    double tare_s = 0.5;                 ///< s; 0 = no tare, the bias is zero
    double tare_timeout_s = 5.0;         ///< s, from start() on
    double tare_force_tolerance = 2.0;   ///< N
    double tare_moment_tolerance = 0.2;  ///< N m
    double time_constant_s = 0.01;       ///< s; 0 = no filter
    double dead_force = 0.0;             ///< N
    double dead_moment = 0.0;            ///< N m
  } params;
  In<Quantity::kSensorWrench> ft;
  In<Quantity::kPose> x;  ///< measured
  In<Quantity::kTool> tool;
  Out<Quantity::kWrench> h;
  Out<Quantity::kSensorWrench> bias;  ///< zero until it is known
  Out<Quantity::kFlag> taring;

  template <class Visitor>
  void describe(Visitor& visit) {
    visit.param("max_force", params.max_force, kPositive, "N");
    visit.param("max_moment", params.max_moment, kPositive, "N m");
    visit.param("stuck_s", params.stuck_s, Range{0.0, 10.0}, "s");
    visit.param("tare_s", params.tare_s, Range{0.0, 60.0}, "s");
    visit.param("tare_timeout_s", params.tare_timeout_s, Range{0.0, 600.0}, "s");
    visit.param("tare_force_tolerance", params.tare_force_tolerance, kNonNegative, "N");
    visit.param("tare_moment_tolerance", params.tare_moment_tolerance, kNonNegative, "N m");
    visit.param("time_constant_s", params.time_constant_s, Range{0.0, 10.0}, "s");
    visit.param("dead_force", params.dead_force, kNonNegative, "N");
    visit.param("dead_moment", params.dead_moment, kNonNegative, "N m");
    visit.in("ft", ft), visit.in("x", x), visit.in("tool", tool);
    visit.out("h", h), visit.out("bias", bias), visit.out("taring", taring);
  }

  /// Zero wrench; the tare begins, anew after a restart. kSensorNotFinite, kSensorRange. [init]
  Status start();

  /// kSensorNotFinite: ft or its transform is not finite. kSensorRange: |f| or |m| beyond the
  /// sensor's range. kSensorStuck: ft the same to the last bit for stuck_s. kSensorNotSteady: no
  /// tare within tare_timeout_s. [cyclic]
  Status step(double dt_s);
  /// Measures, and has no motion of its own. [cyclic]
  void brake(Status /*why*/, BrakeWay /*way*/) {}

 private:
  Status check() const;
  bool stuck(double dt_s);
  /// One more sample of the tare: ft less the tool's weight.
  Status tare(const Vector6& load, double dt_s);
  /// The weight of the tool at the flange, in its axes R.
  Vector6 weight(const Matrix3& R) const;
  /// From the flange and its axes R to the tip, in base axes.
  Vector6 at_tip(const Vector6& flange, const Matrix3& R) const;
  void filter(const Vector6& contact, double dt_s);

  Vector6 filtered_ = Vector6::Zero();
  double gain_ = 0.0, period_s_ = 0.0;  // of the filter, and the period for which it holds
  Vector6 last_ = Vector6::Zero();      // ft of the cycle before
  int unchanged_ = 0;                   // cycles that ft has been the same
  // The tare's interval: sum, extremes and number of samples; and the cycles since start.
  Vector6 sum_ = Vector6::Zero(), low_ = Vector6::Zero(), high_ = Vector6::Zero();
  int samples_ = 0, cycles_ = 0;
};

}  // namespace tactus
