// BumplessTransfer: the difference between what a law commands and what it would command with other
// parameters, taken to zero in a given time. When its parameters change, a law adds the difference
// to its output, so that the output does not step:
//
//   y(t) = law(new parameters) + s(t) d,    d = last output - law(new parameters, last inputs)
//
// s = u^2 (3 - 2 u), with u falling from 1 to 0: neither y nor its rate steps, and of d there is
// never more per second than 1.5 |d| / time.
//
// A board without a server of references has none: TACTUS_TUNING=0.
#pragma once

#include <cmath>

#include "kernel/core/joint_limits.hpp"
#include "kernel/core/verdict.hpp"

namespace tactus {

/// True if parameters may change while the pipeline runs.
inline constexpr bool kTuning = TACTUS_TUNING != 0;
/// Time in which a difference fades, s; longer if a limit requires it.
inline constexpr double kTransfer_s = 0.5;

template <class Vector, bool kPresent = kTuning>
class BumplessTransfer {
 public:
  /// [any]
  void clear() { left_s_ = 0.0; }
  /// Begins with `difference`, in place of what is left. [between two cycles]
  void start(const Vector& difference, double seconds) {
    difference_ = difference;
    left_s_ = seconds_ = seconds;
  }
  /// True while something is left. [any]
  bool runs() const { return left_s_ > 0.0; }
  /// Returns what is left. [any]
  Vector value() const {
    const double u = runs() ? left_s_ / seconds_ : 0.0;
    return u * u * (3.0 - 2.0 * u) * difference_;
  }
  /// Advances one period. [cyclic]
  void step(double dt_s) { left_s_ = left_s_ > dt_s ? left_s_ - dt_s : 0.0; }

 private:
  Vector difference_ = Vector::Zero();
  double left_s_ = 0.0, seconds_ = 1.0;
};

template <class Vector>
class BumplessTransfer<Vector, false> {
 public:
  void clear() {}
  void start(const Vector& /*difference*/, double /*seconds*/) {}
  bool runs() const { return false; }
  Vector value() const { return Vector::Zero(); }
  void step(double /*dt_s*/) {}
};

/// Returns the time in which a difference of torques fades with at most half the torque rate, s.
/// [any]
inline double transfer_time(const JointVector& difference, const JointLimits& limits) {
  constexpr double kShare = 0.5, kSteepest = 1.5;
  return (kSteepest / kShare * difference.cwiseAbs().cwiseQuotient(limits.dtau_max))
      .cwiseMax(kTransfer_s)
      .maxCoeff();
}

/// Judges the torque that a law would command with other parameters. Returns kCommandNotFinite if
/// it is not finite, and kEffortLimit if a joint's is beyond its limit and beyond the present one:
/// the difference would then take long to fade, and the guard would limit what follows. [any]
inline Verdict judge_torque(const JointVector& next, const JointVector& present,
                            const JointLimits& limits) {
  if (!next.allFinite()) return {Status::kCommandNotFinite};
  const JointVector most = limits.tau_max.cwiseMax(present.cwiseAbs());
  for (int i = 0; i < kDof; ++i)
    if (!(std::abs(next[i]) <= most[i])) return {Status::kEffortLimit, -1, i, next[i], most[i]};
  return {};
}

}  // namespace tactus
