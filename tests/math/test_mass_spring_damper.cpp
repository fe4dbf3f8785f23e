// Tests one axis of mass, spring and damper against a matrix exponential in quad precision,
// textbook solutions, and energy. The Euler rule appears for comparison only.
#include "kernel/math/mass_spring_damper.hpp"

#include <quadmath.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "tests/support/testing.hpp"

namespace tactus {
namespace {

__extension__ using Quad = __float128;
using State = MassSpringDamper::State;
using Matrix = std::array<std::array<Quad, 3>, 3>;

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) c[i][j] += a[i][k] * b[k][j];
  return c;
}

struct Axis {
  double m, d, k;

  /// exp of {x, v, f}' = [v, (f - d v - k x) / m, 0] over t: power series and repeated squaring.
  Matrix exact(double t) const {
    constexpr int kHalvings = 50;
    const Quad h = ldexpq(t, -kHalvings);
    const Matrix a = {
        {{0, h, 0},
         {-k / static_cast<Quad>(m) * h, -d / static_cast<Quad>(m) * h, h / static_cast<Quad>(m)},
         {0, 0, 0}}};
    // exp(a) - 1, because the one would cost a small a its digits
    Matrix rest = a, term = a;
    for (int n = 2; n < 5; ++n) {
      term = product(term, a);
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
          term[i][j] /= n;
          rest[i][j] += term[i][j];
        }
    }
    for (int n = 0; n < kHalvings; ++n) {  // (1 + r)^2 - 1 = 2 r + r^2
      const Matrix square = product(rest, rest);
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) rest[i][j] = 2 * rest[i][j] + square[i][j];
    }
    for (std::size_t i = 0; i < 3; ++i) rest[i][i] += 1;
    return rest;
  }
  MassSpringDamper axis(double t) const { return {m, d, k, t}; }
  double energy(const State& s) const { return 0.5 * (m * s.v * s.v + k * s.x * s.x); }
};

/// Calls check(axis, period) for random axes over many decades, including critical damping, its
/// nearest neighbours and zeros.
template <class Check>
void over_axes(int count, Check check) {
  std::mt19937_64 random(20260420);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < count; ++i) {
    Axis axis{i % 2 ? 1.0 : std::pow(10.0, 6.0 * unit(random) - 3.0),
              std::pow(10.0, 8.0 * unit(random) - 4.0), std::pow(10.0, 10.0 * unit(random) - 4.0)};
    const double critical = 2.0 * std::sqrt(axis.m * axis.k);
    if (i % 7 == 0) axis.d = 0.0;
    if (i % 11 == 0) axis.k = 0.0;
    if (i % 5 == 0) axis.d = critical * (1.0 + (unit(random) - 0.5) * std::pow(10.0, -(i % 17)));
    check(axis, 1e-3 * (1.0 + 7.0 * unit(random)));
  }
}

// Proves AD-1.

void one_period_is_the_matrix_exponential_in_quad_precision(void**) {
  double worst = 0.0;
  over_axes(4000, [&](const Axis& a, double t) {
    const Matrix e = a.exact(t);
    const MassSpringDamper axis = a.axis(t);
    const std::array<State, 3> ours = {axis.step({1.0, 0.0}, 0.0), axis.step({0.0, 1.0}, 0.0),
                                       axis.step({0.0, 0.0}, 1.0)};
    const double w = std::max(1.0, std::sqrt(a.k / a.m) * t);  // velocities in units of x per t
    for (std::size_t j = 0; j < 3; ++j) {
      const double x = static_cast<double>(e[0][j]), v = static_cast<double>(e[1][j]);
      const double size = j == 0 ? 1.0 : j == 1 ? t : std::min(t * t / a.m, 2.0 / a.k);
      worst = std::max(worst, std::abs(ours[j].x - x) / (size * w));
      worst = std::max(worst, std::abs(ours[j].v - v) * t / (size * w * w));
    }
  });
  print_message("worst error %.2g\n", worst);
  assert_true(worst < 2e-15);
}

/// Step response from rest, by the textbook formula.
double textbook(const Axis& a, double f, double t) {
  if (a.k == 0.0 && a.d == 0.0) return f / a.m * t * t / 2.0;
  if (a.k == 0.0) return f / a.d * (t + a.m / a.d * std::expm1(-a.d / a.m * t));
  const double w = std::sqrt(a.k / a.m), zeta = a.d / (2.0 * std::sqrt(a.m * a.k));
  const double wd = w * std::sqrt(std::abs(1.0 - zeta * zeta)), decay = std::exp(-zeta * w * t);
  if (zeta < 1.0)
    return f / a.k * (1.0 - decay * (std::cos(wd * t) + zeta * w / wd * std::sin(wd * t)));
  if (zeta == 1.0) return f / a.k * (1.0 - decay * (1.0 + w * t));
  const double slow = zeta * w - wd, fast = zeta * w + wd;
  return f / a.k *
         (1.0 - (fast * std::exp(-slow * t) - slow * std::exp(-fast * t)) / (fast - slow));
}

constexpr Axis kTextbookAxes[] = {{2.0, 8.0, 200.0},  {2.0, 40.0, 200.0}, {2.0, 400.0, 200.0},
                                  {2.0, 0.0, 200.0},  {2.0, 8.0, 0.0},    {2.0, 0.0, 0.0},
                                  {2.0, 4e4, 2000.0}, {2.0, 8.0, 2e6}};

void a_force_that_is_switched_is_followed_as_textbooks_have_it(void**) {
  for (const Axis& a : kTextbookAxes)
    for (const double t : {1e-3, 2e-3, 8e-3}) {
      const MassSpringDamper axis = a.axis(t);
      State s;
      for (int i = 1; i <= 2.0 / t; ++i) {  // 10 N, after 0.8 s -5 N: the sum of two responses
        const double now = t * i;
        s = axis.step(s, now < 0.8 + 0.5 * t ? 10.0 : -5.0);
        const double expected =
            textbook(a, 10.0, now) + (now > 0.8 ? textbook(a, -15.0, now - 0.8) : 0.0);
        ASSERT_NEAR(s.x, expected, 1e-9);
      }
    }
}

void the_response_at_an_instant_does_not_depend_on_the_period(void**) {
  for (const Axis& a : kTextbookAxes) {
    const MassSpringDamper slow = a.axis(8e-3), middle = a.axis(2e-3), fast = a.axis(1e-3);
    State s, m, f;
    for (int i = 0; i < 250; ++i) {
      const double force = (i / 50) % 2 ? -20.0 : 30.0;
      s = slow.step(s, force);
      for (int j = 0; j < 4; ++j) m = middle.step(m, force);
      for (int j = 0; j < 8; ++j) f = fast.step(f, force);
      ASSERT_NEAR(m.x, s.x, 1e-11 * (1.0 + std::abs(s.x)));
      ASSERT_NEAR(f.x, s.x, 1e-11 * (1.0 + std::abs(s.x)));
      ASSERT_NEAR(f.v, s.v, 1e-10 * (1.0 + std::abs(s.v)));
    }
  }
}

void without_a_force_the_energy_never_grows_and_nothing_is_unbounded(void**) {
  over_axes(2000, [](const Axis& a, double t) {
    const MassSpringDamper axis = a.axis(t);
    State s = {0.1, -0.3};
    double energy = a.energy(s);
    const double first = energy;
    for (int i = 0; i < 200; ++i) {
      s = axis.step(s, 0.0);
      assert_true(a.energy(s) <= energy + 1e-13 * first);
      energy = a.energy(s);
    }
  });
}

void without_a_damper_the_energy_stays_for_a_million_periods(void**) {
  for (const Axis& a : {Axis{1.0, 0.0, 1e6}, Axis{1.0, 0.0, 100.0}, Axis{50.0, 0.0, 20000.0}}) {
    const MassSpringDamper axis = a.axis(8e-3);
    State s = {0.1, 0.0};
    for (int i = 0; i < 1000000; ++i) s = axis.step(s, 0.0);
    ASSERT_NEAR(a.energy(s) / a.energy({0.1, 0.0}), 1.0, 1e-9);
  }
}

void it_settles_where_the_spring_balances_the_force(void**) {
  over_axes(2000, [](const Axis& a, double t) {
    if (a.k < 1e-3 || a.d == 0.0) return;
    const double x = 12.0 / a.k;
    const State s = a.axis(t).step({x, 0.0}, 12.0);
    ASSERT_NEAR(s.x / x, 1.0, 1e-15);  // balanced: it stays
    ASSERT_NEAR(s.v * t / x, 0.0, 1e-15 * std::max(1.0, a.k * t * t / a.m));
    const MassSpringDamper seconds = a.axis(0.1);  // any period will do for waiting
    State later;
    for (int i = 0; i < 1000; ++i) later = seconds.step(later, 12.0);
    const double slowest = std::min(a.k / a.d, a.d / (2.0 * a.m)) * 100.0;  // decay rate times time
    ASSERT_NEAR(later.x / x, 1.0, 1e-9 + 3.0 * (1.0 + slowest) * std::exp(-slowest));
  });
}

/// Gains of the wall experiment: m = 50 kg, zeta = 7.5, k = 20000 N/m. Explicit rules are stable
/// only up to 6.6 ms.
void the_wall_gains_are_stable_at_8_ms_where_euler_is_not(void**) {
  const Axis wall{50.0, 15000.0, 20000.0};
  const auto euler_after_a_second = [&](double t) {
    double x = 0.0, v = 0.0;  // semi-implicit: the new velocity moves the position
    for (int i = 0; i < 1.0 / t; ++i) {
      v += t * (10.0 - wall.d * v - wall.k * x) / wall.m;
      x += t * v;
    }
    return x;
  };
  ASSERT_NEAR(euler_after_a_second(6e-3), textbook(wall, 10.0, 1.0), 1e-4);
  assert_true(std::abs(euler_after_a_second(8e-3)) > 1e6);

  const MassSpringDamper axis = wall.axis(8e-3);
  State s;
  for (int i = 1; i <= 1250; ++i) {
    s = axis.step(s, 10.0);
    assert_true(s.x > 0.0 && s.x < 10.0 / wall.k * (1.0 + 1e-12));
    ASSERT_NEAR(s.x, textbook(wall, 10.0, 8e-3 * i), 1e-12);
  }
  ASSERT_NEAR(s.x, 10.0 / wall.k, 1e-8);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(one_period_is_the_matrix_exponential_in_quad_precision),
      cmocka_unit_test(a_force_that_is_switched_is_followed_as_textbooks_have_it),
      cmocka_unit_test(the_response_at_an_instant_does_not_depend_on_the_period),
      cmocka_unit_test(without_a_force_the_energy_never_grows_and_nothing_is_unbounded),
      cmocka_unit_test(without_a_damper_the_energy_stays_for_a_million_periods),
      cmocka_unit_test(it_settles_where_the_spring_balances_the_force),
      cmocka_unit_test(the_wall_gains_are_stable_at_8_ms_where_euler_is_not),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
