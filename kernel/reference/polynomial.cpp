#include "kernel/reference/polynomial.hpp"

#include <cmath>
#include <cstddef>

#include "kernel/loop_bound.hpp"

namespace tactus {
namespace {

constexpr int kMaxRoots = Polynomial::kOrder;
constexpr int kBisections = 60;  // 2^-60 of the segment: below the rounding of a double

/// Points of [0, T] between which a function is monotone, ends included.
struct Knots {
  std::array<double, kMaxRoots + 2> t{};
  std::size_t count = 0;
  void add(double value) { t[count++] = value; }
};

/// The zero of f in [lo, hi], where f changes its sign once.
double bisect(const Polynomial& f, double lo, double hi) {
  const bool rising = f.at(hi) > 0.0;
  for (int i = 0; i < kBisections; ++i) {
    const double middle = 0.5 * (lo + hi);
    ((f.at(middle) > 0.0) == rising ? hi : lo) = middle;
  }
  return 0.5 * (lo + hi);
}

/// Ends of [0, T] and the sign changes of f in between, given the knots of f's derivative.
Knots zeros(const Polynomial& f, const Knots& monotone, LoopBound<10>& brackets) {
  Knots found;
  found.add(monotone.t[0]);
  for (std::size_t i = 1; i < monotone.count; ++i) {
    brackets.tick();
    const double lo = monotone.t[i - 1], hi = monotone.t[i];
    if ((f.at(lo) > 0.0) != (f.at(hi) > 0.0)) found.add(bisect(f, lo, hi));
  }
  found.add(monotone.t[monotone.count - 1]);
  return found;
}

}  // namespace

/// Horner's rule with the remainders kept.
Polynomial Polynomial::from(double begin) const {
  Polynomial moved = *this;
  for (std::size_t i = 0; i < kOrder; ++i) {
    for (std::size_t k = kOrder; k > i; --k) moved.c[k - 1] += begin * moved.c[k];
  }
  return moved;
}

Polynomial linear(const Boundary& from, const Boundary& to, double T) {
  return {{from.p, (to.p - from.p) / T}};
}

Polynomial cubic(const Boundary& from, const Boundary& to, double T) {
  const double d = to.p - from.p;
  return {{from.p, from.v, (3.0 * d - (2.0 * from.v + to.v) * T) / (T * T),
           (-2.0 * d + (from.v + to.v) * T) / (T * T * T)}};
}

Polynomial quintic(const Boundary& from, const Boundary& to, double T) {
  const double T2 = T * T, T3 = T2 * T;
  const double d = to.p - from.p;
  return {{from.p, from.v, 0.5 * from.a,
           (20.0 * d - (8.0 * to.v + 12.0 * from.v) * T - (3.0 * from.a - to.a) * T2) / (2.0 * T3),
           (-30.0 * d + (14.0 * to.v + 16.0 * from.v) * T + (3.0 * from.a - 2.0 * to.a) * T2) /
               (2.0 * T2 * T2),
           (12.0 * d - 6.0 * (to.v + from.v) * T - (from.a - to.a) * T2) / (2.0 * T2 * T3)}};
}

Extremes hull(const Polynomial& polynomial, double T) {
  // b_j = sum over i <= j of C(j, i) / C(5, i) c_i T^i.   [Farouki 2012, eq. 13]
  constexpr double kWeight[6][6] = {
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
    for (std::size_t i = 0; i < scaled.size(); ++i) b += row[i] * scaled[i];
    if (!(b >= found.min)) found.min = b;
    if (!(b <= found.max)) found.max = b;
  }
  return found;
}

Extremes extremes(const Polynomial& polynomial, double T) {
  std::array<Polynomial, Polynomial::kOrder + 1> f;  // f[k]: k-th derivative
  f[0] = polynomial;
  for (std::size_t k = 1; k < f.size(); ++k) f[k] = f[k - 1].derivative();

  Knots knots;
  knots.add(0.0);
  knots.add(T);
  LoopBound<10> brackets;  // 1 + 2 + 3 + 4: k knots have at most k - 1 zeros between them
  for (std::size_t k = f.size() - 2; k >= 1; --k) knots = zeros(f[k], knots, brackets);

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
