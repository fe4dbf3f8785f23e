// The bounds of the next step of a commanded sequence: velocity and acceleration keep their limits
// now, and the position limits can be kept for ever. Everything is per cycle: a step is a velocity
// times the period (rad), a change of step an acceleration times the period squared (rad).
//
// With changes of at most c, a step s is followed at best by s - c, s - 2c, ... down to 0. Their
// sum is
//
//   n s - c n (n + 1) / 2,   n = floor(s / c)
//
// so a step that leaves this distance to the limit can always be followed by another that does:
// once a sequence has started inside, the band is never empty, whatever is commanded.
#pragma once

#include "kernel/core/joint_limits.hpp"

namespace tactus {

/// Allowances by which a sequence may exceed its limits, so that a reference that reaches them
/// exactly passes: that of positions is for numbers from a file, those of differences also for the
/// rounding of positions. At 1 kHz these are 1e-8 rad/s and 1e-8 rad/s^2.
inline constexpr double kPositionAllowance = 1e-9;  ///< rad, plus less than 1e-12 of rounding
inline constexpr double kStepAllowance = 1e-11;     ///< rad per cycle
inline constexpr double kChangeAllowance = 1e-14;   ///< rad per cycle^2

/// Bounds of one joint's sequence, without the allowances.
struct StepLimits {
  double q_min = 0.0, q_max = 0.0;  ///< rad
  double step = 0.0;                ///< rad per cycle
  double change = 0.0;              ///< rad per cycle^2
  double jerk = 0.0;                ///< rad per cycle^3

  /// Returns the bounds of one joint at a period. [init]
  static StepLimits of(const JointLimits& limits, int joint, double period_s);
  /// True if a change of change exceeds the jerk limit. [any]
  bool jerky(double change_of_change) const;
};

struct StepBand {
  double lo, hi;
  /// False for NaN. [any]
  bool contains(double step) const { return step >= lo && step <= hi; }
};

/// Returns the largest step that can come to rest within `distance`, itself included. [any]
double braking_step(double distance, double change);

/// Returns the steps allowed from position q after the step `last`. [any]
StepBand allowed_steps(const StepLimits& limits, double q, double last);

}  // namespace tactus
