// Approach: the bound of the velocity on the way to points or chunks of a new motion, as those of a
// leader that is far from the arm. It lasts until the reference is at the place where it is to
// rest, or, beside what moves, as near as it goes in kNear_s.
#pragma once

#include "kernel/reference/space/judge_channels.hpp"

namespace tactus {

template <class Space>
class Approach {
 public:
  using Point = typename Space::Point;
  using Limits = typename Space::Limits;

  /// Sets the largest velocity, rad/s, for a tip m/s and rad/s; 0: none. [init]
  void start(const Limits& limits, double speed) {
    speed_ = speed;
    slow_ = limits.slowed(speed);
  }
  /// Starts the approach to a new target. [cyclic]
  void begin() { on_ = speed_ > 0.0; }
  bool on() const { return on_; }
  /// Returns the limits on the way from `reference` to `base`: `own`, or slower ones. [cyclic]
  const Limits& limits(const Point& reference, const Point& base, const Limits& own) {
    if (on_) on_ = !judge_distance<Space>(reference, base, near(base)).ok();
    return on_ ? slow_ : own;
  }

 private:
  static constexpr double kNear_s = 0.05;

  double near(const Point& base) const { return base.standing() ? 0.0 : kNear_s * speed_; }

  double speed_ = 0.0;
  bool on_ = false;
  Limits slow_;
};

}  // namespace tactus
