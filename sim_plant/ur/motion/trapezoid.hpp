// The time law of a move: a trapezoid of speed over a distance d,
//
//   v0 -> top -> v1,  top = min(v, sqrt(a d + (v0^2 + v1^2) / 2))
//
// from one speed to another, both zero for a move from rest to rest. If v0 is above v, the move
// slows down to v first.
#pragma once

namespace tactus::ur {

class Trapezoid {
 public:
  /// Returns the law over `d` >= 0 from `v0` to `v1` with top speed `v` and acceleration `a` > 0.
  /// If `a` is too small to get from `v0` to `v1`, the law uses the acceleration needed. [any]
  static Trapezoid over(double d, double v0, double v1, double v, double a);

  double duration_s() const { return first_s_ + flat_s_ + last_s_; }
  double top() const { return top_; }
  double position(double t_s) const;  ///< 0 before the beginning, d after the end
  double speed(double t_s) const;     ///< its derivative
  /// Returns when `x` is reached, at the latest when braking begins, s.
  double time_at(double x) const;

 private:
  double v0_ = 0.0, top_ = 0.0, v1_ = 0.0, way_ = 0.0;
  double first_s_ = 0.0, flat_s_ = 0.0, last_s_ = 0.0;
  double a0_ = 0.0, a1_ = 0.0;  // of the first part, and of the last, which brakes
};

}  // namespace tactus::ur
