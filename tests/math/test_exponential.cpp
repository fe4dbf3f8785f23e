// Tests the exponential and the mean of a decay against quad precision.
#include "kernel/math/exponential.hpp"

#include <quadmath.h>

#include <algorithm>
#include <limits>
#include <random>

#include "tests/support/testing.hpp"

namespace tactus {
namespace {

__extension__ using Quad = __float128;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLn2 = 0.693147180559945309417;
constexpr double kPromised_ulp = 0.9, kPromisedMean_ulp = 3.0;

/// |value - exact| in units in the last place of a double near `exact`.
double error_ulp(double value, Quad exact) {
  int exponent = 0;
  frexpq(exact, &exponent);
  return static_cast<double>(fabsq(static_cast<Quad>(value) - exact) / ldexpq(1, exponent - 53));
}

double exponential_error(double x) {
  return error_ulp(exponential(x), expq(x));
}

double mean_error(double x) {
  return error_ulp(mean_decay(x), x == 0.0 ? 1 : -expm1q(-x) / x);
}

// Proves KER-5.

void the_exponential_of_zero_is_one_and_grows_both_ways(void**) {
  assert_true(exponential(0.0) == 1.0 && exponential(-0.0) == 1.0);
  assert_true(exponential(1e-300) == 1.0 && exponential(-1e-300) == 1.0);
  assert_true(exponential(1.0) > 2.7 && exponential(-1.0) < 0.4);
}

void random_exponents_are_within_the_promised_error(void**) {
  std::mt19937_64 random(20260418);
  for (const double range : {1e-3, 0.4, 3.0, 700.0}) {
    std::uniform_real_distribution<double> exponent(-range, range);
    double worst = 0.0;
    for (int i = 0; i < 100000; ++i) worst = std::max(worst, exponential_error(exponent(random)));
    print_message("|x| <= %-8g worst error %.3f ulp\n", range, worst);
    assert_true(worst < kPromised_ulp);
  }
}

/// The boundary between two polynomials.
void exponents_halfway_between_multiples_of_ln_2_are_within_the_promised_error(void**) {
  double worst = 0.0;
  for (int n = -1020; n < 1022; ++n) {
    const double x = (n + 0.5) * kLn2;
    for (const double near : {std::nextafter(x, -kInfinity), x, std::nextafter(x, kInfinity)})
      worst = std::max(worst, exponential_error(near));
  }
  print_message("between n ln 2   worst error %.3f ulp\n", worst);
  assert_true(worst < kPromised_ulp);
}

void beyond_the_normal_numbers_it_is_zero_or_infinite(void**) {
  assert_true(exponential_error(kExponentialMin) < kPromised_ulp);
  assert_true(exponential_error(kExponentialMax) < kPromised_ulp);
  for (const double x : {std::nextafter(kExponentialMin, -kInfinity), -1e9, -1e300, -kInfinity})
    assert_true(exponential(x) == 0.0);
  for (const double x : {std::nextafter(kExponentialMax, kInfinity), 1e9, 1e300, kInfinity})
    assert_true(exponential(x) == kInfinity);
}

void the_mean_of_a_decay_is_within_the_promised_error(void**) {
  std::mt19937_64 random(20260419);
  double worst = 0.0;
  for (const double range : {1e-12, 0.4, 3.0, 700.0}) {
    std::uniform_real_distribution<double> extent(0.0, range);
    for (int i = 0; i < 100000; ++i) worst = std::max(worst, mean_error(extent(random)));
  }
  for (double x = 1e-310; x < 1e300; x *= 1.7) worst = std::max(worst, mean_error(x));
  for (const double x : {0.5 * kLn2, std::nextafter(0.5 * kLn2, 1.0)})
    worst = std::max(worst, mean_error(x));
  print_message("mean of a decay  worst error %.3f ulp\n", worst);
  assert_true(worst < kPromisedMean_ulp);
  assert_true(mean_decay(0.0) == 1.0 && mean_decay(kInfinity) == 0.0);
}

void what_is_no_number_gives_nan(void**) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  assert_true(std::isnan(exponential(nan)) && std::isnan(mean_decay(nan)));
}

/// The recorded number is the FNV-1a hash of the results' bits, word by word, at exponents made by
/// integer arithmetic. Every compiler, flag and processor must give the same.
void the_bits_are_the_recorded_ones(void**) {
  std::uint64_t state = 1, hash = 0xcbf29ce484222325u;
  for (int i = 0; i < 100000; ++i) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    const double x = (static_cast<double>(state >> 32) - 0x1p31) * (i % 2 ? 0x1p-31 : 0x1p-22);
    for (const double value : {exponential(x), mean_decay(std::abs(x))})
      hash = (hash ^ bits_of(value)) * 0x100000001b3u;
  }
  assert_true(hash == 0x0e20b6af9e889ce5u);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_exponential_of_zero_is_one_and_grows_both_ways),
      cmocka_unit_test(random_exponents_are_within_the_promised_error),
      cmocka_unit_test(exponents_halfway_between_multiples_of_ln_2_are_within_the_promised_error),
      cmocka_unit_test(beyond_the_normal_numbers_it_is_zero_or_infinite),
      cmocka_unit_test(the_mean_of_a_decay_is_within_the_promised_error),
      cmocka_unit_test(what_is_no_number_gives_nan),
      cmocka_unit_test(the_bits_are_the_recorded_ones),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
