#include "kernel/math/mass_spring_damper.hpp"

#include <cmath>

#include "kernel/math/exponential.hpp"
#include "kernel/math/so3.hpp"

namespace tactus {
namespace {

/// Divided differences exp[-x1, -x2] and exp[0, -x1, -x2], and the remainder of a unit velocity.
struct Response {
  double first, second, velocity;
};

/// For s < 1 and p < 1, whatever the roots are: their magnitudes are less than one, and the terms
/// of the power series in them are the complete homogeneous polynomials h_n = -s h_(n-1) - p
/// h_(n-2).
Response by_series(double s, double p) {
  constexpr int kTerms = 18;  // the rest is 2^-56 of the sum: |h_n| <= n + 1
  double first = 0.0, second = 0.0, factorial = 1.0;  // of n + 1
  double h = 1.0, last = 0.0;
  for (int n = 0; n < kTerms; ++n) {
    first += h / factorial;
    factorial *= n + 2;
    second += h / factorial;
    const double next = -s * h - p * last;  // of the roots -x1, -x2
    last = h;
    h = next;
  }
  return {first, second, 1.0 - s * first - p * second};
}

/// Two real roots: no oscillation. `half` is half the distance between them.
Response overdamped(double s, double p, double half) {
  const double x2 = 0.5 * s + half, x1 = p / x2;
  const double first = exponential(-x1) * mean_decay(2.0 * half);
  return {first, (mean_decay(x1) - first) / x2, exponential(-x2) - x1 * first};
}

/// A pair of complex roots; `square` is the square of their imaginary part.
Response underdamped(double s, double p, double square) {
  const double decay = exponential(-0.5 * s);
  const Stumpff c = stumpff(square);  // c0 the cosine, c1 the sine over its argument
  const double first = decay * c.c1;
  const double position = decay * c.c0 + 0.5 * s * first;  // remainder of a unit displacement
  return {first, (1.0 - position) / p, decay * c.c0 - 0.5 * s * first};
}

}  // namespace

MassSpringDamper::MassSpringDamper(double mass, double damping, double stiffness, double period_s)
    : mass_(mass), stiffness_(stiffness) {
  const double s = damping * period_s / mass;
  const double p = stiffness * period_s * period_s / mass;
  const double discriminant = 0.25 * s * s - p;
  const Response response = s < 1.0 && p < 1.0  ? by_series(s, p)
                            : discriminant >= 0 ? overdamped(s, p, std::sqrt(discriminant))
                                                : underdamped(s, p, -discriminant);
  g1_ = period_s * response.first;
  g2_ = period_s * period_s * response.second;
  r_ = response.velocity;
}

}  // namespace tactus
