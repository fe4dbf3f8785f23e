// VelocityLimiter: keeps one joint's sequence of commanded velocities within the velocity and
// acceleration limits and low enough to brake before the position limits, counted from the measured
// position. A robot that executes a command within a cycle then never reaches them; one that lags
// by a time T passes its braking point by up to T times its speed.
//
// The jerk is counted but not limited, as in PositionLimiter.
#pragma once

#include "kernel/guard/step_band.hpp"

namespace tactus {

class VelocityLimiter {
 public:
  /// Starts at the measured velocity. [init]
  void start(const StepLimits& limits, double period_s, double dq);
  /// True if `wanted` would be sent unchanged. [cyclic]
  bool follows(double wanted, double q) const;
  /// Returns the velocity to send if `wanted` (finite, rad/s) is commanded with the joint at q.
  /// [cyclic]
  double next(double wanted, double q);
  /// The last velocity sent, rad/s. [any]
  double sent() const { return step_ / period_s_; }
  /// True if the last velocity sent exceeded the jerk limit. [any]
  bool jerky() const { return jerky_; }

 private:
  StepLimits limits_;
  double period_s_ = 1.0;
  double step_ = 0.0, change_ = 0.0;  // rad per cycle, rad per cycle^2
  bool jerky_ = false;
};

}  // namespace tactus
