// PositionLimiter: keeps one joint's sequence of commanded positions within position, velocity and
// acceleration limits, braking distance included. A command within them is sent unchanged. After
// any other, the sequence moves as fast as it may, and joins the commands without overshoot if they
// are at rest or move steadily.
//
// The jerk is counted but not limited. The acceleration of a cubic reference steps at every
// waypoint, and such a reference must pass; and a brake that first has to build up its deceleration
// needs more distance, within which the guard would overrule references that keep every limit.
#pragma once

#include "kernel/guard/step_band.hpp"

namespace tactus {

class PositionLimiter {
 public:
  /// Starts at rest at q. If that is beyond a position limit, the sequence may stay there, and come
  /// back, but not go out again. [init]
  void start(const StepLimits& limits, double q);
  /// True if `wanted` would be sent unchanged. [cyclic]
  bool follows(double wanted) const;
  /// Returns the position to send if `wanted` (finite, rad) is commanded. [cyclic]
  double next(double wanted);
  /// Returns the next position to send to come to rest as fast as possible. [cyclic]
  double brake();
  /// The last position sent, rad. [any]
  double sent() const { return sent_; }
  /// The last change of the position sent, rad per cycle. [any]
  double step() const { return step_; }
  /// True if the last position sent exceeded the jerk limit. [any]
  bool jerky() const { return jerky_; }

 private:
  void draw_in();
  double move(double to, double target);

  double q_min_ = 0.0, q_max_ = 0.0;               // rad, those that hold inside
  StepLimits limits_;                              // those that hold now
  double sent_ = 0.0, step_ = 0.0, change_ = 0.0;  // rad, rad per cycle, rad per cycle^2
  double target_ = 0.0;                            // last commanded, within position limits
  bool jerky_ = false;
};

}  // namespace tactus
