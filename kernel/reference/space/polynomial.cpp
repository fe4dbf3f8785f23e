#include "kernel/reference/space/polynomial.hpp"

#include <cmath>
#include <cstddef>

#include "kernel/core/loop_bound.hpp"

namespace tactus {
namespace {

constexpr int kMaxRoots = Polynomial::kOrder;
/// Down to 2^-24 of the segment. A function is flat at an extremum, so its value there is off by
/// the square of that only, which is its rounding.
constexpr int kBisections = 24;

/// Times in [0, T], ends included, between which a function is monotone.
struct Knots {
  std::array<double, kMaxRoots + 2> t{};
  std::size_t count = 0;
  void add(double value) { t[count++] = value; }
};

/// Returns f(t) for f of that degree; higher coefficients are zero.
template <std::size_t degree>
double value(const Polynomial& f, double t) {
  double value = f.c[degree];
  for (std::size_t i = degree; i-- > 0;) value = value * t + f.c[i];
  return value;
}

/// Returns the ends of [0, T] and the zeros of the parabola f in between, by the formula that does
/// not cancel: with q = -(c1 +- root) / 2, of the sign of c1, they are q / c2 and c0 / q. Scaled,
/// so that no square overflows.
Knots parabola_zeros(const Polynomial& f, double T) {
  const double size = std::max({std::abs(f.c[0]), std::abs(f.c[1]), std::abs(f.c[2])});
  const double c0 = f.c[0] / size, c1 = f.c[1] / size, c2 = f.c[2] / size;
  const double root = std::sqrt(c1 * c1 - 4.0 * c0 * c2);  // NaN: there are none
  const double q = -0.5 * (c1 + std::copysign(root, c1));
  const double one = q / c2, other = c0 / q;
  const double first = one < other ? one : other, second = one < other ? other : one;
  Knots found;
  found.add(0.0);
  if (first > 0.0 && first < T) found.add(first);
  if (second > 0.0 && second < T) found.add(second);
  found.add(T);
  return found;
}

/// Returns the zero of f in [lo, hi], where f changes its sign once.
template <std::size_t degree>
double bisect(const Polynomial& f, double lo, double hi) {
  const bool rising = value<degree>(f, hi) > 0.0;
  for (int i = 0; i < kBisections; ++i) {
    const double middle = 0.5 * (lo + hi);
    ((value<degree>(f, middle) > 0.0) == rising ? hi : lo) = middle;
  }
  return 0.5 * (lo + hi);
}

/// Returns the ends of [0, T] and the sign changes of f in between, given the times between which f
/// is monotone: the zeros of its derivative, one less than f may have, and both ends.
template <std::size_t degree>
[[gnu::noinline]] Knots zeros(const Polynomial& f, const Knots& monotone) {
  Knots found;
  found.add(monotone.t[0]);
  LoopBound<static_cast<int>(degree)> brackets;
  for (std::size_t i = 1; i < monotone.count; ++i) {
    brackets.tick();
    const double lo = monotone.t[i - 1], hi = monotone.t[i];
    if ((value<degree>(f, lo) > 0.0) != (value<degree>(f, hi) > 0.0))
      found.add(bisect<degree>(f, lo, hi));
  }
  found.add(monotone.t[monotone.count - 1]);
  return found;
}

}  // namespace

Extremes hull(const Polynomial& polynomial, double T) {
  // b_j = sum over i <= j of C(j, i) / C(5, i) c_i T^i.   [Farouki 2012, eq. 13]
  static constexpr double kWeight[6][6] = {
      {1.0},
      {1.0, 0.2},
      {1.0, 0.4, 0.1},
      {1.0, 0.6, 0.3, 0.1},
      {1.0, 0.8, 0.6, 0.4, 0.2},
      {1.0, 1.0, 1.0, 1.0, 1.0, 1.0},
  };
  std::array<double, Polynomial::kOrder + 1> scaled = polynomial.c;
  double power = 1.0;
  for (double& c : scaled) {
    c *= power;
    power *= T;
  }
  Extremes found = {polynomial.c[0], polynomial.c[0]};
  for (const auto& row : kWeight) {
    double b = 0.0;
#pragma GCC unroll 6
    for (std::size_t i = 0; i < scaled.size(); ++i) b += row[i] * scaled[i];
    if (!(b >= found.min)) found.min = b;
    if (!(b <= found.max)) found.max = b;
  }
  return found;
}

Extremes extremes(const Polynomial& polynomial, double T) {
  const Polynomial first = polynomial.derivative(), second = first.derivative();
  const Knots knots = zeros<4>(first, zeros<3>(second, parabola_zeros(second.derivative(), T)));

  Extremes found = {polynomial.at(0.0), polynomial.at(0.0)};
  LoopBound<6> values;
  for (std::size_t i = 0; i < knots.count; ++i) {
    values.tick();
    const double value = polynomial.at(knots.t[i]);
    if (!(value >= found.min)) found.min = value;
    if (!(value <= found.max)) found.max = value;
  }
  return found;
}

}  // namespace tactus
