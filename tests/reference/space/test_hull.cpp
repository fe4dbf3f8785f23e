// The quick bound of a polynomial, for every order up to the fifth: it is what its Bernstein
// coefficients span. They are drawn, and the polynomial is expanded from them by the powers of
// t / T and 1 - t / T, which is not how the bound finds them again.
#include <algorithm>
#include <random>

#include "kernel/reference/space/polynomial.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr unsigned kSeed = 20261123;
constexpr int kOrder = Polynomial::kOrder;

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
  std::mt19937_64 bits{kSeed};
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
  print_message("seed %u\n", kSeed);
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
      cmocka_unit_test(the_hull_of_every_order_lies_between_coefficients_and_extremes),
      cmocka_unit_test(the_hull_is_no_wider_than_it_must_be),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
