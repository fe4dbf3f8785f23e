// Tests sincos against quad precision. The points are uniform at four scales, and the doubles next
// to every multiple of pi/2 in range, where reduction is hardest.
#include "kernel/math/sincos.hpp"

#include <quadmath.h>

#include <algorithm>
#include <limits>
#include <random>

#include "tests/support/testing.hpp"

namespace tactus {
namespace {

__extension__ using Quad = __float128;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kHalfPi = 1.57079632679489661923;
constexpr double kPromised_ulp = 0.85;

/// |value - exact| in units in the last place of a double near `exact`.
double error_ulp(double value, Quad exact) {
  int exponent = 0;
  frexpq(exact, &exponent);
  return static_cast<double>(fabsq(static_cast<Quad>(value) - exact) / ldexpq(1, exponent - 53));
}

double worst_error_ulp(double x) {
  Quad sin_x, cos_x;
  sincosq(x, &sin_x, &cos_x);
  const SinCos ours = sincos(x);
  return std::max(error_ulp(ours.sin, sin_x), error_ulp(ours.cos, cos_x));
}

// Proves KER-3.

void the_sine_of_zero_is_zero_with_its_sign_and_the_cosine_one(void**) {
  assert_true(sincos(0.0).sin == 0.0 && !std::signbit(sincos(0.0).sin));
  assert_true(sincos(-0.0).sin == 0.0 && std::signbit(sincos(-0.0).sin));
  assert_true(sincos(0.0).cos == 1.0 && sincos(-0.0).cos == 1.0);
}

void random_angles_are_within_the_promised_error(void**) {
  std::mt19937_64 random(20191120);
  for (const double range : {0.8, 3.2, 100.0, kSinCosMax_rad}) {
    std::uniform_real_distribution<double> angle(-range, range);
    double worst = 0.0;
    for (int i = 0; i < 100000; ++i) worst = std::max(worst, worst_error_ulp(angle(random)));
    print_message("|x| <= %-8g worst error %.3f ulp\n", range, worst);
    assert_true(worst < kPromised_ulp);
  }
}

void angles_next_to_multiples_of_half_pi_are_within_the_promised_error(void**) {
  double worst = 0.0;
  for (int n = 1; n * kHalfPi < kSinCosMax_rad; ++n) {
    const double x = n * kHalfPi;
    for (const double near : {std::nextafter(x, 0.0), x, std::nextafter(x, kInfinity)}) {
      worst = std::max({worst, worst_error_ulp(near), worst_error_ulp(-near)});
    }
  }
  print_message("next to n pi/2   worst error %.3f ulp\n", worst);
  assert_true(worst < kPromised_ulp);
}

void small_angles_keep_their_relative_accuracy(void**) {
  for (double x = 0.5; x > std::numeric_limits<double>::min(); x *= 0.37) {
    assert_true(worst_error_ulp(x) < kPromised_ulp);
  }
  const double tiny = std::numeric_limits<double>::denorm_min();
  assert_true(sincos(tiny).sin == tiny && sincos(tiny).cos == 1.0);
}

void sine_is_odd_and_cosine_even_to_the_last_bit(void**) {
  std::mt19937_64 random(20191121);
  std::uniform_real_distribution<double> angle(0.0, kSinCosMax_rad);
  for (int i = 0; i < 10000; ++i) {
    const double x = angle(random);
    const SinCos plus = sincos(x), minus = sincos(-x);
    assert_true(plus.sin == -minus.sin && plus.cos == minus.cos);
  }
}

void what_is_not_an_angle_gives_nan_for_both(void**) {
  assert_true(std::isfinite(sincos(kSinCosMax_rad).sin));
  assert_true(std::isfinite(sincos(-kSinCosMax_rad).cos));
  const double above = std::nextafter(kSinCosMax_rad, kInfinity);
  for (const double x : {above, -above, 1e300, -1e300, kInfinity, -kInfinity,
                         std::numeric_limits<double>::quiet_NaN()}) {
    assert_true(std::isnan(sincos(x).sin));
    assert_true(std::isnan(sincos(x).cos));
  }
}

/// The recorded number is the FNV-1a hash of the results' bits, word by word, at angles made by
/// integer arithmetic. Every compiler, flag and processor must give the same.
void the_bits_are_the_recorded_ones(void**) {
  std::uint64_t state = 1, hash = 0xcbf29ce484222325u;
  for (int i = 0; i < 100000; ++i) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    const double x = (static_cast<double>(state >> 32) - 0x1p31) * (i % 2 ? 0x1p-29 : 0x1p-15);
    const SinCos result = sincos(x);
    for (const double value : {result.sin, result.cos}) {
      hash = (hash ^ bits_of(value)) * 0x100000001b3u;
    }
  }
  assert_true(hash == 0xb20b225f243d7a7du);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_sine_of_zero_is_zero_with_its_sign_and_the_cosine_one),
      cmocka_unit_test(random_angles_are_within_the_promised_error),
      cmocka_unit_test(angles_next_to_multiples_of_half_pi_are_within_the_promised_error),
      cmocka_unit_test(small_angles_keep_their_relative_accuracy),
      cmocka_unit_test(sine_is_odd_and_cosine_even_to_the_last_bit),
      cmocka_unit_test(what_is_not_an_angle_gives_nan_for_both),
      cmocka_unit_test(the_bits_are_the_recorded_ones),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
