// Converts the measurement of a force/torque sensor at the flange to the wrench that the
// environment exerts on the tool, at its tip, in base axes.
//
//   ft = [f; m] = bias + [m_t g; c x m_t g] + contact        at the flange, in its axes
//
// m_t and c are the tool's mass and centre of mass, and g = 9.81 m/s^2 downwards in the world,
// turned into the flange's axes. The tool's inertial force is not modelled: m_t times its
// acceleration counts as contact. Then, with p the tip in the flange frame and R the flange in the
// base,
//
//   f_tip = R f_contact,   m_tip = R (m_contact - p x f_contact)
//
// A low-pass y' = (u - y) / time_constant_s follows, exact for an input that is constant over a
// period, and a dead band that shortens f by `dead_force` and m by `dead_moment`, so that nothing
// jumps at its edge.
//
// Tare: after start(), h is zero until ft less the tool's weight has stayed within the tare
// tolerances, largest less smallest on each axis, for tare_s without a break; its mean over that
// interval is the bias. A break restarts the interval. During the tare the robot must be at rest
// and touch nothing: a steady contact becomes part of the bias. The filter then starts from zero:
// with a time constant, h does not step; without, it steps by up to the tare tolerances.
//
// A sensor drifts. begin_tare() requests a new bias while the block runs, by the same interval.
// Until it has passed, h comes from the old bias, so that a law continues to yield. Then the new
// bias holds, and what h changes by fades in kTransfer_s:
//
//   h(t) = contact by the new bias + s(t) (h before - contact by the new bias)     fade.hpp
//
// If the bias would move by more than max_tare_force or max_tare_moment, from the present one or
// from that of the start, which may be a contact, or the signal is not steady within
// tare_timeout_s, the tare is refused and the old bias stays. A contact within these limits, or a
// steady acceleration, becomes part of the bias: a law that yields then presses by as much more.
#pragma once

#include "kernel/core/brake.hpp"
#include "kernel/core/describe.hpp"
#include "kernel/core/port.hpp"
#include "kernel/core/status.hpp"
#include "kernel/math/bumpless_transfer.hpp"
#include "kernel/math/tare_request.hpp"

namespace tactus {

class WrenchFrontEnd {
 public:
  static constexpr const char* kType = "wrench_front_end";

  struct Params : TareLimits<> {
    double max_force = kRequired;        ///< N, range of the sensor, for |f| as measured
    double max_moment = kRequired;       ///< N m, for |m|
    double stuck_s = 0.0;                ///< s; longer than the sensor's sample time; 0 = no check
    double tare_s = 0.5;                 ///< s; 0 = no tare, the bias is zero
    double tare_timeout_s = 5.0;         ///< s, after start() or begin_tare()
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
  Out<Quantity::kFlag> taring;        ///< by start(): until the bias is known

  template <class Visitor>
  void describe(Visitor& visit) {
    visit.param("max_force", params.max_force, kPositive, "N");
    visit.param("max_moment", params.max_moment, kPositive, "N m");
    visit.param("stuck_s", params.stuck_s, Range{0.0, 10.0}, "s");
    visit.param("tare_s", params.tare_s, Range{0.0, 60.0}, "s");
    visit.param("tare_timeout_s", params.tare_timeout_s, Range{0.0, 600.0}, "s");
    visit.param("tare_force_tolerance", params.tare_force_tolerance, kNonNegative, "N");
    visit.param("tare_moment_tolerance", params.tare_moment_tolerance, kNonNegative, "N m");
    params.describe_limits(visit);
    visit.param("time_constant_s", params.time_constant_s, Range{0.0, 10.0}, "s");
    visit.tunable("dead_force", params.dead_force, kNonNegative, "N");
    visit.tunable("dead_moment", params.dead_moment, kNonNegative, "N m");
    visit.in("ft", ft);
    visit.in("x", x);
    visit.in("tool", tool);
    visit.out("h", h);
    visit.out("bias", bias);
    visit.out("taring", taring);
  }

  /// Sets the wrench to zero and begins a new tare. Returns kSensorNotFinite, kSensorRange. [init]
  [[gnu::cold]] Status start();

  /// Returns kSensorNotFinite if ft or its transform is not finite, kSensorRange if |f| or |m| is
  /// beyond the sensor's range, kSensorStuck if ft is the same to the last bit for stuck_s, and
  /// kSensorNotSteady if there is no tare within tare_timeout_s. [cyclic]
  Status step(double dt_s);
  /// Refuses a requested tare; nothing else, as the block has no motion of its own.
  /// [cyclic]
  void brake(Status why, BrakeWay /*way*/) { request_.end({why}); }
  /// Begins a tare while the block runs. Returns kNotOffered if tare_s is 0, kMailboxFull while one
  /// is under way. [between two cycles], after a step
  Status begin_tare();
  /// True until the requested tare has its result. [between two cycles]
  bool tares() const { return request_.runs(); }
  /// The result of the last one: kOk, kTareLimit, kSensorNotSteady, why it was braked, or
  /// kNotStarted if the block was restarted. [between two cycles]
  Verdict tared() const { return request_.verdict(); }
  /// Changes the tunable parameters: h continues, and its difference fades in kTransfer_s.
  /// [between two cycles], after a step
  void retune(const Params& next, const JointLimits& limits);

 private:
  Status check() const;
  bool stuck(double dt_s);
  /// Adds one sample to the tare: ft less the tool's weight. True: it was steady for tare_s.
  bool sample(const Vector6& load, double dt_s);
  /// `rested`: the samples were steady for tare_s.
  Status tare(bool rested, double dt_s);
  void tare_again(bool rested, const Matrix3& R, double dt_s);
  /// Returns the weight of the tool at the flange, in the flange's axes R.
  Vector6 weight(const Matrix3& R) const;
  /// Moves a wrench from the flange, in its axes R, to the tip, in base axes.
  Vector6 at_tip(const Vector6& flange, const Matrix3& R) const;
  void filter(const Vector6& contact, double dt_s);
  /// Returns the filtered wrench less the dead band.
  Vector6 contact() const;

  Vector6 filtered_ = Vector6::Zero();
  double gain_ = 0.0, period_s_ = 0.0;  // of the filter, and the period for which it holds
  Vector6 last_ = Vector6::Zero();      // ft of the last cycle
  int unchanged_ = 0;                   // cycles without a change of ft
  BumplessTransfer<Vector6> transfer_;
  TareRequest<> request_;
  // The tare's interval: sum, extremes and number of samples; and the cycles since its begin.
  Vector6 sum_ = Vector6::Zero(), low_ = Vector6::Zero(), high_ = Vector6::Zero();
  int samples_ = 0, cycles_ = 0;
};

}  // namespace tactus
