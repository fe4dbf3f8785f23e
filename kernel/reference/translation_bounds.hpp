// How fast a point moves on a polynomial path: the largest length of its velocity, acceleration and
// jerk, from outside.
#pragma once

#include "kernel/reference/rotation_segment.hpp"

namespace tactus {

/// No |p'| [m/s], |p''| [m/s^2] and |p'''| [m/s^3] on the path is larger, to rounding.
struct TranslationBounds {
  double v, a, j;
};

/// Of p on [0, T]. From outside: exact for a straight line at constant speed, at most 1 % above
/// what occurs on cubics and quintics from rest to rest, and 2 % with ends that move at up to a few
/// times the mean speed. NaN coefficients give NaN. Takes 33 times as long as evaluating p and its
/// derivatives. [any]
TranslationBounds translation_bounds(const VectorPolynomial& p, double T);

}  // namespace tactus
