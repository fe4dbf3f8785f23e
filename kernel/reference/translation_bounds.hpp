// How fast a point moves on a polynomial path: the largest length of its velocity, acceleration and
// jerk, from outside.
#pragma once

#include "kernel/reference/rotation_segment.hpp"

namespace tactus {

/// No |p'| [m/s], |p''| [m/s^2] and |p'''| [m/s^3] on the path is larger, to rounding.
struct TranslationBounds {
  double v, a, j;
};

/// Of p on [0, T]. From outside: exact for a straight line at constant speed, at most 1 % (v), 2 %
/// (a) and 1 % (j) above what occurs on cubics and quintics from rest to rest, and as close for
/// ends that move at up to ten times the mean speed. NaN coefficients give NaN. [any]
TranslationBounds translation_bounds(const VectorPolynomial& p, double T);

}  // namespace tactus
