// One axis of mass, spring and damper,
//
//   m x'' + d x' + k x = f,
//
// moved by a whole period T at once: exact for a force that is constant during the period, at every
// m > 0, d >= 0, k >= 0 and T, and so stable wherever the physics is. With the acceleration
// a = (f - k x) / m that the damper does not see,
//
//   x+ = x + g1 v + g2 a
//   v+ = r v + g1 a
//
// g1 is the response of x, one period later, to a unit impulse per mass, g2 that to a unit
// acceleration, r what is left of a unit velocity. At rest in balance (v = 0, a = 0) nothing
// rounds. With s = d T / m, p = k T^2 / m, the roots -x1, -x2 of z^2 + s z + p, and divided
// differences of the exponential (Newton interpolation in Moler and Van Loan, Nineteen dubious ways
// to compute the exponential of a matrix, 1978):
//
//   g1 = T exp[-x1, -x2],  g2 = T^2 exp[0, -x1, -x2],  r = 1 - s g1/T - p g2/T^2
#pragma once

namespace tactus {

class MassSpringDamper {
 public:
  struct State {
    double x = 0.0, v = 0.0;  ///< m or rad, and per second
  };

  MassSpringDamper() = default;
  /// mass > 0, damping >= 0, stiffness >= 0, SI units. Where an undamped axis turns through more
  /// than kSinCosMax_rad per period, sqrt(k/m) T, step() gives NaN. [any]
  MassSpringDamper(double mass, double damping, double stiffness, double period_s);

  /// The state one period later, `force` being constant until then. [cyclic]
  State step(const State& now, double force) const {
    const double a = (force - stiffness_ * now.x) / mass_;
    return {now.x + (g1_ * now.v + g2_ * a), r_ * now.v + g1_ * a};
  }

 private:
  double mass_ = 1.0, stiffness_ = 0.0;
  double g1_ = 0.0, g2_ = 0.0, r_ = 1.0;  // s, s^2, 1
};

}  // namespace tactus
