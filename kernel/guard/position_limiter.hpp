// PositionLimiter: one joint's sequence of commanded positions, kept within position, velocity and
// acceleration limits, braking distance included. What keeps them is sent as it came; after
// anything else the sequence moves as fast as it may, and joins it without overshoot if it stands
// or moves steadily.
//
// The jerk is counted and not shaped. A reference through cubics steps its acceleration at every
// waypoint by nature and must pass; and a brake that has to build up its deceleration first needs
// more room, in which the guard would overrule references that keep every limit.
#pragma once

#include "kernel/guard/step_band.hpp"

namespace tactus {

class PositionLimiter {
 public:
  /// Begins at rest at q. [init]
  void start(const StepLimits& limits, double q);
  /// What is sent when `wanted` (finite, rad) is commanded. [cyclic]
  double next(double wanted);
  /// What is sent to come to rest as fast as may be. [cyclic]
  double brake();
  /// The last that was sent, rad. [any]
  double sent() const { return sent_; }
  /// Whether the last that was sent took more than the jerk limit. [any]
  bool jerky() const { return jerky_; }

 private:
  double move(double to, double target);

  StepLimits limits_;
  double sent_ = 0.0, step_ = 0.0, change_ = 0.0;  // rad, rad per cycle, rad per cycle^2
  double target_ = 0.0;                            // what was wanted last, within position limits
  bool jerky_ = false;
};

}  // namespace tactus
