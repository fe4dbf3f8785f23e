// Tests arctangent against quad precision. The points are random directions of all sizes, arguments
// of any exponent, the rays where the folding changes, and the ends of the exponent range.
#include "kernel/math/arctangent.hpp"

#include <quadmath.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tests/support/testing.hpp"

namespace tactus {
namespace {

__extension__ using Quad = __float128;

using Limits = std::numeric_limits<double>;
constexpr double kInfinity = Limits::infinity();
const double kNaN = std::nan("");
constexpr double kPi = 3.14159265358979323846;
constexpr double kPromised_ulp = 0.75;

/// |value - exact| in units in the last place of a double near `exact`, subnormal ones included.
double error_ulp(double value, Quad exact) {
  int exponent = 0;
  frexpq(exact, &exponent);
  const Quad ulp = ldexpq(1, std::max(exponent - 53, -1074));
  return static_cast<double>(fabsq(static_cast<Quad>(value) - exact) / ulp);
}

double error_at(double y, double x) {
  return error_ulp(arctangent(y, x), atan2q(y, x));
}

/// The largest error over the four quadrants and both orders of the arguments.
double worst_around(double y, double x) {
  double worst = 0.0;
  for (const double a : {y, -y}) {
    for (const double b : {x, -x}) worst = std::max({worst, error_at(a, b), error_at(b, a)});
  }
  return worst;
}

bool same(double a, double b) {
  return bits_of(a) == bits_of(b);
}

// Proves KER-3.

void the_axes_and_both_zeros_have_the_angles_and_signs_of_atan2(void**) {
  for (const double x : {0.0, Limits::denorm_min(), 1.0, Limits::max()}) {
    assert_true(same(arctangent(0.0, x), 0.0) && same(arctangent(-0.0, x), -0.0));
    assert_true(same(arctangent(0.0, -x), kPi) && same(arctangent(-0.0, -x), -kPi));
  }
  for (const double y : {Limits::denorm_min(), 1.0, Limits::max()}) {
    for (const double zero : {0.0, -0.0}) {
      assert_true(arctangent(y, zero) == kPi / 2.0 && arctangent(-y, zero) == -kPi / 2.0);
    }
    assert_true(arctangent(y, y) == kPi / 4.0 && arctangent(y, -y) == 3.0 * kPi / 4.0);
  }
}

void random_directions_are_within_the_promised_error(void**) {
  std::mt19937_64 random(20260401);
  std::uniform_real_distribution<double> angle(-kPi, kPi);
  double worst = 0.0;
  for (int i = 0; i < 300000; ++i) {
    const double a = angle(random);
    worst = std::max(worst, error_at(std::sin(a), std::cos(a)));
  }
  print_message("on the circle           worst error %.3f ulp\n", worst);
  assert_true(worst < kPromised_ulp);
}

void numbers_of_any_exponent_are_within_the_promised_error(void**) {
  std::mt19937_64 random(20260402);
  double near = 0.0, any = 0.0;
  for (int i = 0; i < 300000; ++i) {
    const double x = double_of(random()), y = double_of(random());
    if (!std::isfinite(x) || !std::isfinite(y)) continue;
    any = std::max(any, error_at(y, x));
    // equal mantissas, at most a factor 2^8 apart, anywhere in the range
    const int base = static_cast<int>(random() % 2030) - 1020, apart = static_cast<int>(i % 17) - 8;
    int unused;
    const double x_near = std::ldexp(std::frexp(x, &unused), base);
    const double y_near = std::ldexp(std::frexp(y, &unused), base + apart);
    if (std::isfinite(x_near) && std::isfinite(y_near))
      near = std::max(near, error_at(y_near, x_near));
  }
  print_message("any exponents           worst error %.3f ulp\n", any);
  print_message("exponents near          worst error %.3f ulp\n", near);
  assert_true(any < kPromised_ulp && near < kPromised_ulp);
}

void next_to_the_rays_of_the_folding_the_error_is_as_promised(void**) {
  std::mt19937_64 random(20260403);
  std::uniform_real_distribution<double> number(1.0, 2.0);
  double worst = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const double x = number(random);
    for (const double slope : {1.0, std::sqrt(2.0) - 1.0, 0.5, 0x1p-20, 0x1p-27, 0x1p-60}) {
      const double y = slope * x;
      for (const double next : {std::nextafter(y, 0.0), y, std::nextafter(y, kInfinity)}) {
        worst = std::max(worst, worst_around(next, x));
      }
    }
  }
  print_message("rays of the folding     worst error %.3f ulp\n", worst);
  assert_true(worst < kPromised_ulp);
}

void the_ends_of_the_exponent_range_are_within_the_promised_error(void**) {
  std::mt19937_64 random(20260404);
  std::uniform_real_distribution<double> number(0.5, 1.0);
  double worst = 0.0;
  for (int x = -1074; x <= 1024; x += 2) {
    for (const int y :
         {-1074, -1060, -1022, -1000, -970, -874, -475, -200, 0, 599, 600, 601, 1024}) {
      const double a = std::ldexp(number(random), x), b = std::ldexp(number(random), y);
      worst = std::max(worst, worst_around(b, a));
    }
  }
  print_message("ends of the range       worst error %.3f ulp\n", worst);
  assert_true(worst < kPromised_ulp);
}

void it_is_odd_in_y_to_the_last_bit(void**) {
  std::mt19937_64 random(20260405);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  for (int i = 0; i < 10000; ++i) {
    const double y = number(random), x = number(random);
    assert_true(same(arctangent(-y, x), -arctangent(y, x)));
  }
}

void what_is_not_finite_gives_nan(void**) {
  for (const double bad : {kInfinity, -kInfinity, kNaN, -kNaN}) {
    for (const double other : {0.0, -0.0, 1.0, -1.0, Limits::max(), kInfinity, -kInfinity, kNaN}) {
      assert_true(std::isnan(arctangent(bad, other)));
      assert_true(std::isnan(arctangent(other, bad)));
    }
  }
  assert_true(std::isfinite(arctangent(Limits::max(), -Limits::max())));
}

/// The recorded number is the FNV-1a hash of the results' bits, word by word, at points made by
/// integer arithmetic. Every compiler, flag and processor must give the same.
void the_bits_are_the_recorded_ones(void**) {
  std::uint64_t state = 1, hash = 0xcbf29ce484222325u;
  const auto number = [&state] {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state >> 32) - 0x1p31;
  };
  for (int i = 0; i < 100000; ++i) {
    const double y = number() * (i % 2 ? 1.0 : 0x1p-5), x = number();
    hash = (hash ^ bits_of(arctangent(y, x))) * 0x100000001b3u;
  }
  print_message("%llx\n", (unsigned long long)hash);
  assert_true(hash == 0x643477ed300560eeu);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_axes_and_both_zeros_have_the_angles_and_signs_of_atan2),
      cmocka_unit_test(random_directions_are_within_the_promised_error),
      cmocka_unit_test(numbers_of_any_exponent_are_within_the_promised_error),
      cmocka_unit_test(next_to_the_rays_of_the_folding_the_error_is_as_promised),
      cmocka_unit_test(the_ends_of_the_exponent_range_are_within_the_promised_error),
      cmocka_unit_test(it_is_odd_in_y_to_the_last_bit),
      cmocka_unit_test(what_is_not_finite_gives_nan),
      cmocka_unit_test(the_bits_are_the_recorded_ones),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
