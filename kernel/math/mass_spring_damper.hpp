// One axis of mass, spring and damper,
//
//   m x'' + d x' + k x = f,
//
// advanced by a whole period T at once. The step is exact for a force that is constant during the
// period, at every m > 0, d >= 0, k >= 0 and T, and so it is stable wherever the physics is. With
// the acceleration without damper, a = (f - k x) / m,
//
//   x+ = x + g1 v + g2 a
//   v+ = r v + g1 a
//
// g1 is the response of x after one period to a unit impulse per mass, g2 that to a unit
// acceleration, and r the remainder of a unit velocity. In equilibrium (v = 0, a = 0) nothing
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
  /// mass > 0, damping >= 0, stiffness >= 0, SI units. step() returns NaN if an undamped axis turns
  /// through more than kSinCosMax_rad per period, sqrt(k/m) T. [any]
  [[gnu::cold]] MassSpringDamper(double mass, double damping, double stiffness, double period_s);

  /// Returns the state one period later under a constant `force`. [cyclic]
  State step(const State& now, double force) const {
    const double a = (force - stiffness_ * now.x) / mass_;
    return {now.x + (g1_ * now.v + g2_ * a), r_ * now.v + g1_ * a};
  }

 private:
  double mass_ = 1.0, stiffness_ = 0.0;
  double g1_ = 0.0, g2_ = 0.0, r_ = 1.0;  // s, s^2, 1
};

}  // namespace tactus
