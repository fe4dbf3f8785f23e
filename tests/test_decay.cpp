// The decay of a first-order system against the C library in quad precision.
#include "kernel/math/decay.hpp"

#include <quadmath.h>

#include <limits>

#include "tests/testing.hpp"

namespace tactus {
namespace {

// Proves KER-3.

void it_is_the_exponential_within_its_bound(void**) {
  for (double x = 1e-12; x < 64.0; x *= 1.0009) {
    const double expected = static_cast<double>(expq(-static_cast<__float128>(x)));
    ASSERT_NEAR(decay(x) / expected, 1.0, 1e-13);
  }
  assert_true(decay(0.0) == 1.0);
}

void after_very_long_nothing_is_left(void**) {
  assert_true(decay(64.0) == 0.0 && decay(std::numeric_limits<double>::infinity()) == 0.0);
}

void what_is_not_a_number_stays_so(void**) {
  assert_true(std::isnan(decay(std::nan(""))));
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(it_is_the_exponential_within_its_bound),
      cmocka_unit_test(after_very_long_nothing_is_left),
      cmocka_unit_test(what_is_not_a_number_stays_so),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
