// The time law of a move: over a way with a trapezoid of speed,
//
//   v0 -> top -> v1,  top = min(v, sqrt(a d + (v0^2 + v1^2) / 2))
//
// from one speed to another, both zero for a move from rest to rest. Where v0 is more than v, it is
// slowed down to v first.
#pragma once

namespace tactus::ur {

class Trapezoid {
 public:
  /// Over `d` >= 0 from `v0` to `v1`, top speed `v` and acceleration `a` > 0. Where that is too
  /// little to come from the one to the other, the acceleration is what it takes. [any]
  static Trapezoid over(double d, double v0, double v1, double v, double a);

  double duration_s() const { return first_s_ + flat_s_ + last_s_; }
  double top() const { return top_; }
  double position(double t_s) const;  ///< 0 before the beginning, the way after the end
  double speed(double t_s) const;     ///< its derivative
  /// When `x` is reached, at the latest when the slowing down begins, s.
  double time_at(double x) const;

 private:
  double v0_ = 0.0, top_ = 0.0, v1_ = 0.0, way_ = 0.0;
  double first_s_ = 0.0, flat_s_ = 0.0, last_s_ = 0.0;
  double a0_ = 0.0, a1_ = 0.0;  // of the first part, and of the last, where it slows down
};

}  // namespace tactus::ur
