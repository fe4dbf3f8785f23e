// Polynomials of a segment: the values at their ends, and their extrema against dense sampling.
// The quick bound of a polynomial, for every order up to the fifth: it is what its Bernstein
// coefficients span. They are drawn, and the polynomial is expanded from them by the powers of
// t / T and 1 - t / T, which is not how the bound finds them again.
#include <algorithm>
#include <limits>
#include <random>

#include "kernel/reference/space/polynomial.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const double kNaN = std::nan("");
constexpr unsigned kSeed = 20260301;
constexpr int kOrder = Polynomial::kOrder;
constexpr int kSamples = 1000;

using Join = Polynomial (*)(const Boundary&, const Boundary&, double);

/// Random numbers in [-1, 1], and durations from a millisecond to a quarter of an hour.
struct Random {
  std::mt19937_64 bits{kSeed};
  double unit() { return std::uniform_real_distribution<double>(-1.0, 1.0)(bits); }
  double duration() { return std::pow(10.0, 3.0 * unit()); }
  /// Returns a polynomial whose terms have the same size at the end of [0, T].
  Polynomial polynomial(double T) {
    Polynomial p;
    for (std::size_t i = 0; i < p.c.size(); ++i) p.c[i] = unit() / std::pow(T, i);
    return p;
  }
  /// Returns a polynomial that is stationary at four points in or near [0, T], every other one a
  /// double zero of the derivative.
  Polynomial wavy(double T) {
    std::array<double, kOrder> slope{1.0};  // in units of T; (t - r) multiplied in one by one
    double root = 0.0;
    for (std::size_t n = 1; n < slope.size(); ++n) {
      if (n == 1 || unit() > 0.0) root = 0.5 + 0.6 * unit();
      for (std::size_t i = n + 1; i-- > 0;)
        slope[i] = (i > 0 ? slope[i - 1] : 0.0) - (i < n ? root * slope[i] : 0.0);
    }
    Polynomial p;
    p.c[0] = unit();
    for (std::size_t i = 1; i < p.c.size(); ++i)
      p.c[i] = slope[i - 1] / static_cast<double>(i) / std::pow(T, i);
    return p;
  }
};

/// Returns the sum of the terms' sizes at T, by which rounding is measured.
double size(const Polynomial& p, double T) {
  double sum = 0.0;
  for (std::size_t i = 0; i < p.c.size(); ++i) sum += std::abs(p.c[i]) * std::pow(T, i);
  return sum;
}

Extremes sampled(const Polynomial& p, double T) {
  Extremes found = {kInfinity, -kInfinity};
  for (int k = 0; k <= kSamples; ++k) {
    const double value = p.at(T * k / kSamples);
    found = {std::min(found.min, value), std::max(found.max, value)};
  }
  return found;
}

/// Asserts that the extrema are at least the sampled ones, and exceed them by no more than the
/// polynomial can rise between two samples: half the second derivative times the square of half a
/// step.
void assert_exact(const Polynomial& p, double T) {
  const Extremes exact = extremes(p, T), seen = sampled(p, T);
  const Extremes bend = hull(p.derivative().derivative(), T);
  const double rounding = 1e-14 * size(p, T);
  const double half_step = 0.5 * T / kSamples;
  const double between = 0.5 * std::max(-bend.min, bend.max) * half_step * half_step;
  assert_true(exact.max >= seen.max - rounding && exact.min <= seen.min + rounding);
  assert_true(exact.max <= seen.max + between + rounding);
  assert_true(exact.min >= seen.min - between - rounding);
}

void assert_boundary(const Polynomial& p, double t, const Boundary& expected, int fields,
                     double rounding) {
  const Polynomial v = p.derivative();
  ASSERT_NEAR(p.at(t), expected.p, rounding);
  if (fields > 1) ASSERT_NEAR(v.at(t), expected.v, rounding);
  if (fields > 2) ASSERT_NEAR(v.derivative().at(t), expected.a, rounding);
}

// Proves RG-2, RG-6.

void value_and_derivative_follow_the_power_rule(void**) {
  const Polynomial p = {{1.0, 2.0, 3.0, 4.0, 5.0, 6.0}};
  assert_true(p.at(0.0) == 1.0 && p.at(1.0) == 21.0 && p.at(2.0) == 321.0);
  const Polynomial d = {{2.0, 6.0, 12.0, 20.0, 30.0, 0.0}};
  assert_true(p.derivative().c == d.c);
}

void a_line_cubic_and_quintic_have_the_textbook_coefficients(void**) {
  const Boundary from = {}, to = {1.0, 0.0, 0.0};
  const Polynomial line = {{0.0, 1.0}}, smooth = {{0.0, 0.0, 3.0, -2.0}};
  const Polynomial minimum_jerk = {{0.0, 0.0, 0.0, 10.0, -15.0, 6.0}};
  assert_true(linear(from, to, 1.0).c == line.c);
  assert_true(cubic(from, to, 1.0).c == smooth.c);
  assert_true(quintic(from, to, 1.0).c == minimum_jerk.c);
}

void both_ends_are_met_in_every_field_the_order_allows(void**) {
  constexpr Join kJoins[] = {linear, cubic, quintic};
  print_message("seed %u\n", kSeed);
  Random random;
  for (int trial = 0; trial < 10000; ++trial) {
    const double T = random.duration();
    Boundary from, to;
    for (Boundary* end : {&from, &to})
      *end = {random.unit(), random.unit() / T, random.unit() / (T * T)};
    for (int order = 0; order < 3; ++order) {
      const Polynomial p = kJoins[order](from, to, T);
      const double rounding = 1e-12 * std::max({1.0, 1.0 / T, 1.0 / (T * T)});
      assert_boundary(p, 0.0, from, order + 1, rounding);
      assert_boundary(p, T, to, order + 1, rounding);
    }
  }
}

void extremes_of_random_polynomials_are_those_of_dense_sampling(void**) {
  print_message("seed %u\n", kSeed);
  Random random;
  for (int trial = 0; trial < 1000; ++trial) {
    const double T = random.duration();
    assert_exact(random.polynomial(T), T);
    assert_exact(random.wavy(T), T);
  }
}

void the_hull_contains_the_extremes(void**) {
  print_message("seed %u\n", kSeed);
  Random random;
  for (int trial = 0; trial < 10000; ++trial) {
    const double T = random.duration();
    const Polynomial p = trial % 2 == 0 ? random.polynomial(T) : random.wavy(T);
    const Extremes outer = hull(p, T), exact = extremes(p, T);
    const double terms = size(p, T), rounding = 1e-14 * terms;
    assert_true(outer.max >= exact.max - rounding && outer.min <= exact.min + rounding);
    assert_true(outer.max <= terms + rounding && outer.min >= -terms - rounding);
  }
}

void the_minimum_jerk_motion_has_its_published_peaks(void**) {
  for (const double T : {1e-3, 1.0, 2.0, 1e3}) {
    for (const double d : {1.0, -0.25}) {
      const Polynomial v = quintic<double>({}, {d, 0.0, 0.0}, T).derivative();
      const Extremes velocity = extremes(v, T), acceleration = extremes(v.derivative(), T);
      const double peak_v = 1.875 * std::abs(d) / T;
      const double peak_a = 10.0 / std::sqrt(3.0) * std::abs(d) / (T * T);  // 5.7735
      ASSERT_NEAR(d > 0.0 ? velocity.max : -velocity.min, peak_v, 1e-12 * peak_v);
      ASSERT_NEAR(d > 0.0 ? velocity.min : velocity.max, 0.0, 1e-12 * peak_v);
      ASSERT_NEAR(acceleration.max, peak_a, 1e-12 * peak_a);
      ASSERT_NEAR(acceleration.min, -peak_a, 1e-12 * peak_a);
    }
  }
}

void a_constant_is_its_own_extreme(void**) {
  for (const double value : {0.0, 3.0, -1e300}) {
    for (const double T : {1e-9, 1.0, 1e9}) {
      const Polynomial p = {{value}};
      const Extremes exact = extremes(p, T), outer = hull(p, T);
      assert_true(exact.min == value && exact.max == value);
      assert_true(outer.min == value && outer.max == value);
    }
  }
}

void a_monotone_polynomial_has_its_extremes_at_the_ends(void**) {
  const Polynomial rising = {{-1.0, 2.0}};                    // 2 t - 1
  const Polynomial pausing = {{-1.0, 3.0, -6.0, 4.0}};        // slope 12 (t - 1/2)^2: a double zero
  const Polynomial fifth = {{0.0, 0.0, 0.0, 0.0, 0.0, 1.0}};  // slope 5 t^4
  for (const Polynomial& p : {rising, pausing, fifth}) {
    const Extremes exact = extremes(p, 1.0);
    assert_true(exact.min == p.at(0.0) && exact.max == p.at(1.0));
  }
}

void multiple_stationary_points_are_found(void**) {
  const Polynomial fourth = {{0.0625, -0.5, 1.5, -2.0, 1.0}};  // (t - 1/2)^4
  ASSERT_NEAR(extremes(fourth, 2.0).min, 0.0, 1e-15);
  ASSERT_NEAR(extremes(fourth, 2.0).max, 5.0625, 1e-15);
  const Polynomial twice = {{0.0, 0.0, 4.0, -8.0, 4.0}};  // 4 t^2 (t - 1)^2: 1/4 at 1/2
  ASSERT_NEAR(extremes(twice, 1.0).min, 0.0, 1e-15);
  ASSERT_NEAR(extremes(twice, 1.0).max, 0.25, 1e-15);
}

void a_number_that_is_not_finite_fails_every_bound(void**) {
  for (std::size_t i = 0; i < kOrder + 1; ++i) {
    for (const double bad : {kNaN, kInfinity, -kInfinity}) {
      Polynomial p = {{1.0, 1.0, 1.0, 1.0, 1.0, 1.0}};
      p.c[i] = bad;
      const Extremes exact = extremes(p, 1.0), outer = hull(p, 1.0);
      assert_false(exact.min >= -1e300 && exact.max <= 1e300);
      assert_false(outer.min >= -1e300 && outer.max <= 1e300);
      if (std::isnan(bad)) assert_true(std::isnan(exact.min) && std::isnan(exact.max));
      if (std::isnan(bad)) assert_true(std::isnan(outer.min) && std::isnan(outer.max));
    }
  }
  const Extremes exact = extremes({{1.0, 1.0}}, kNaN), outer = hull({{1.0, 1.0}}, kNaN);
  assert_true(std::isnan(exact.min) && std::isnan(exact.max));
  assert_true(std::isnan(outer.min) && std::isnan(outer.max));
}

void joining_in_no_time_fails_every_bound(void**) {
  for (const Join join : {Join(linear), Join(cubic), Join(quintic)}) {
    const Extremes velocity = extremes(join({}, {1.0, 0.0, 0.0}, 0.0).derivative(), 0.0);
    assert_false(velocity.min >= -1e300 && velocity.max <= 1e300);
  }
}

constexpr unsigned kHullSeed = 20261123;

/// Sum over j of b[j] C(n, j) x^j (1 - x)^(n - j), x = t / T, in powers of t.
Polynomial expanded(const std::array<double, kOrder + 1>& b, int n, double T) {
  constexpr double kBinomial[6][6] = {{1},          {1, 1},          {1, 2, 1},
                                      {1, 3, 3, 1}, {1, 4, 6, 4, 1}, {1, 5, 10, 10, 5, 1}};
  Polynomial p;
  for (int j = 0; j <= n; ++j) {
    for (int k = 0; k <= n - j; ++k) {
      const double sign = k % 2 == 0 ? 1.0 : -1.0;
      p.c[static_cast<std::size_t>(j + k)] += sign * kBinomial[n][j] * kBinomial[n - j][k] *
                                              b[static_cast<std::size_t>(j)] / std::pow(T, j + k);
    }
  }
  return p;
}

/// Coefficients for order n; now and then one stands out from all others, and each has its turn.
struct Draw {
  std::mt19937_64 bits{kHullSeed};
  double unit() { return std::uniform_real_distribution<double>(-1.0, 1.0)(bits); }
  double duration() { return std::pow(10.0, 3.0 * unit()); }
  std::array<double, kOrder + 1> coefficients(int n, int trial) {
    std::array<double, kOrder + 1> b{};
    for (int j = 0; j <= n; ++j) b[static_cast<std::size_t>(j)] = unit();
    if (trial % 3 != 0) b[static_cast<std::size_t>(trial / 3 % (n + 1))] += trial % 3 == 1 ? 3 : -3;
    return b;
  }
};

// Proves RG-6.

void the_hull_of_every_order_lies_between_coefficients_and_extremes(void**) {
  print_message("seed %u\n", kHullSeed);
  Draw draw;
  for (int n = 0; n <= kOrder; ++n) {
    for (int trial = 0; trial < 3000; ++trial) {
      const double T = draw.duration();
      const auto b = draw.coefficients(n, trial);
      const auto [least, most] = std::minmax_element(b.begin(), b.begin() + n + 1);
      const Polynomial p = expanded(b, n, T);
      const Extremes outer = hull(p, T), exact = extremes(p, T);
      constexpr double kRounding = 1e-12;
      assert_true(outer.min >= *least - kRounding && outer.max <= *most + kRounding);
      assert_true(outer.min <= exact.min + kRounding && outer.max >= exact.max - kRounding);
      for (int k = 0; k <= 100; ++k) {
        const double value = p.at(T * k / 100);
        assert_true(outer.min <= value + kRounding && outer.max >= value - kRounding);
      }
    }
  }
}

/// Of the fifth order the coefficients themselves; of orders 0 and 1 the extremes.
void the_hull_is_no_wider_than_it_must_be(void**) {
  Draw draw;
  for (int n : {0, 1, kOrder}) {
    for (int trial = 0; trial < 3000; ++trial) {
      const double T = draw.duration();
      const auto b = draw.coefficients(n, trial);
      const auto [least, most] = std::minmax_element(b.begin(), b.begin() + n + 1);
      const Extremes outer = hull(expanded(b, n, T), T);
      ASSERT_NEAR(outer.min, *least, 1e-12);
      ASSERT_NEAR(outer.max, *most, 1e-12);
    }
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(value_and_derivative_follow_the_power_rule),
      cmocka_unit_test(a_line_cubic_and_quintic_have_the_textbook_coefficients),
      cmocka_unit_test(both_ends_are_met_in_every_field_the_order_allows),
      cmocka_unit_test(extremes_of_random_polynomials_are_those_of_dense_sampling),
      cmocka_unit_test(the_hull_contains_the_extremes),
      cmocka_unit_test(the_minimum_jerk_motion_has_its_published_peaks),
      cmocka_unit_test(a_constant_is_its_own_extreme),
      cmocka_unit_test(a_monotone_polynomial_has_its_extremes_at_the_ends),
      cmocka_unit_test(multiple_stationary_points_are_found),
      cmocka_unit_test(a_number_that_is_not_finite_fails_every_bound),
      cmocka_unit_test(joining_in_no_time_fails_every_bound),
      cmocka_unit_test(the_hull_of_every_order_lies_between_coefficients_and_extremes),
      cmocka_unit_test(the_hull_is_no_wider_than_it_must_be),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
