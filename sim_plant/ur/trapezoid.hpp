// The time law of movej and movel: from 0 to 1 with a trapezoid of speed, from rest to rest.
#pragma once

namespace tactus::ur {

class Trapezoid {
 public:
  /// Top speed `v` and acceleration `a` > 0, in ways per s and s^2. [any]
  static Trapezoid by_speed(double v, double a);
  /// That lasts `duration_s` > 0, a quarter of it speeding up and a quarter slowing down.
  static Trapezoid by_duration(double duration_s);

  double duration_s() const { return 2.0 * ramp_s_ + flat_s_; }
  double position(double t_s) const;  ///< 0 before the beginning, 1 after the end
  double speed(double t_s) const;     ///< its derivative, 1/s

 private:
  double a_ = 0.0, ramp_s_ = 0.0, flat_s_ = 0.0;
};

}  // namespace tactus::ur
