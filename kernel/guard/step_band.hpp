// What the next step of a commanded sequence may be, so that velocity and acceleration keep their
// limits now and the position limits can be kept for ever. Everything is per cycle: a step is a
// velocity times the period (rad), a change of step an acceleration times its square (rad).
//
// With changes of at most c, a step s is followed at best by s - c, s - 2c, ... down to 0. Together
//
//   n s - c n (n + 1) / 2,   n = floor(s / c)
//
// so a step that keeps this much room before the limit can always be followed by another that does:
// the band is never empty once a sequence has begun inside, whatever is wanted of it.
#pragma once

#include "kernel/joint_limits.hpp"

namespace tactus {

/// What a sequence may exceed its limits by, so that a reference that reaches them exactly passes:
/// of a position for numbers out of a file, of differences for the roundings of positions too. At
/// 1 kHz it is 1e-8 rad/s and 1e-8 rad/s^2.
inline constexpr double kPositionAllowance = 1e-9;  ///< rad, and below 1e-12 of rounding
inline constexpr double kStepAllowance = 1e-11;     ///< rad per cycle
inline constexpr double kChangeAllowance = 1e-14;   ///< rad per cycle^2

/// Bounds of one joint's sequence, without the allowances.
struct StepLimits {
  double q_min = 0.0, q_max = 0.0;  ///< rad
  double step = 0.0;                ///< rad per cycle
  double change = 0.0;              ///< rad per cycle^2
  double jerk = 0.0;                ///< rad per cycle^3

  /// [init]
  static StepLimits of(const JointLimits& limits, int joint, double period_s);
  /// [any]
  bool jerky(double change_of_change) const;
};

struct StepBand {
  double lo, hi;
  /// False for NaN. [any]
  bool contains(double step) const { return step >= lo && step <= hi; }
};

/// The largest step that can come to rest within `distance`, itself included. [any]
double braking_step(double distance, double change);

/// The steps allowed from position q after the step `last`. [any]
StepBand allowed_steps(const StepLimits& limits, double q, double last);

}  // namespace tactus
