// VelocityLimiter: one joint's sequence of commanded velocities, kept within velocity and
// acceleration limits and to what can still be braked before the position limits, counted from the
// measured position. A robot that does what it is told within a cycle then never meets them; one
// that lags by a time T passes its braking point by up to T times its speed.
//
// The jerk is counted and not shaped, as in PositionLimiter.
#pragma once

#include "kernel/guard/step_band.hpp"

namespace tactus {

class VelocityLimiter {
 public:
  /// Begins at the measured velocity. [init]
  void start(const StepLimits& limits, double period_s, double dq);
  /// What is sent when `wanted` (finite, rad/s) is commanded and the joint is at q. [cyclic]
  double next(double wanted, double q);
  /// Whether the last that was sent took more than the jerk limit. [any]
  bool jerky() const { return jerky_; }

 private:
  StepLimits limits_;
  double period_s_ = 1.0;
  double step_ = 0.0, change_ = 0.0;  // rad per cycle, rad per cycle^2
  bool jerky_ = false;
};

}  // namespace tactus
