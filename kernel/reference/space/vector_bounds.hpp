// Upper bounds of the lengths of velocity, acceleration and jerk of a point on a polynomial path,
// and of a body whose rotation vector is one: samples, and how far the path can leave them in
// between.
#pragma once

#include "kernel/reference/space/peaks.hpp"
#include "kernel/reference/space/polynomial.hpp"

namespace tactus {

/// Angular velocity [rad/s] of a body with a given rotation vector, and its first [rad/s^2] and
/// second [rad/s^3] derivative, taken in axes that do not turn, written in the rotated frame.
struct TurningRates {
  Vector3 w, alpha, jerk;
};
/// Returns the rates of exp(phi) at the beginning of a path. [any]
TurningRates turning_rates(const VectorPolynomial& phi);

/// Upper bounds, to rounding, of the lengths of velocity [m/s or rad/s], acceleration and jerk.
struct VectorBounds {
  double v, a, j;
};

/// Returns the bounds of p on [0, T]. They are exact for a straight line at constant speed. For
/// cubics and quintics they are at most 2 % above the true maximum from rest to rest, and 3 %
/// (kClose 6 %) with ends that move. NaN coefficients give NaN. [any]
VectorBounds translation_bounds(const VectorPolynomial& p, double T,
                                Accuracy accuracy = Accuracy::kFine);

/// Returns the bounds of exp(phi) on [0, T]. They are exact for slerp. Velocity, acceleration and
/// jerk exceed the true maximum by at most 2 %, 2 % and 5 % from rest to rest up to half a turn, by
/// 2 %, 5 % and 15 % with ends that move at up to 5 rad per duration, and by more in segments of
/// many turns; with kClose by 2 %, 5 % and 12 %, and by 5 %, 20 % and 40 %. kQuick takes only into
/// account that turning axes add up to half |w|^2 to alpha. [any]
VectorBounds rotation_bounds(const VectorPolynomial& phi, double T,
                             Accuracy accuracy = Accuracy::kFine);

}  // namespace tactus
