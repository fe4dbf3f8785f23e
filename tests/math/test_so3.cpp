// Tests the exponential, logarithm and right Jacobian of SO(3) against quad precision, Eigen, and
// finite differences of eighth order.
#include "kernel/math/so3.hpp"

#include <quadmath.h>

#include <array>
#include <cmath>
#include <limits>

#include "kernel/math/sincos.hpp"
#include "tests/support/rotation_cases.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

__extension__ using Quad = __float128;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const double kNaN = std::nan("");
/// Lengths from subnormal to many turns, including those where a formula changes.
constexpr double kAngles[] = {0.0,        1e-310,      1e-200,    1e-160, 1e-100,     1e-20,
                              1e-9,       1e-8,        1e-4,      0.01,   0.5,        0.999999999,
                              1.0,        1.000000001, 2.0,       3.0,    kPi - 1e-9, kPi,
                              kPi + 1e-9, 6.0,         2.0 * kPi, 50.0};

// Proves RG-10.

void the_stumpff_functions_are_those_of_quad_precision(void**) {
  for (double s = 1e-30; s < 400.0; s *= 1.07) {
    const Stumpff c = stumpff(s);
    const std::array<double, 8> ours = {c.c0, c.c1, c.c2, c.c3, c.c4, c.c5, c.c6, c.c7};
    for (std::size_t n = 0; n < ours.size(); ++n) {
      Quad term = 1, sum = 0;
      for (std::size_t k = 2; k <= n; ++k) term /= k;
      const double first = static_cast<double>(term);
      for (std::size_t k = n + 1; k < n + 120; k += 2) {
        sum += term;
        term *= -static_cast<Quad>(s) / (k * (k + 1));
      }
      const double scale = s < 1.0 ? first : 1.0 + std::sqrt(s);
      ASSERT_NEAR(ours[n], static_cast<double>(sum), 4e-16 * scale);
    }
  }
}

void the_exponential_is_eigens_rotation_about_the_axis(void**) {
  RandomVectors random;
  for (const double angle : kAngles) {
    const Vector3 axis = random.axis();
    const Eigen::Quaterniond expected(Eigen::AngleAxisd(angle, axis));
    ASSERT_NEAR(distance(exp_so3(angle * axis), expected), 0.0, 1e-15 * (1.0 + angle));
    ASSERT_NEAR(exp_so3(angle * axis).norm(), 1.0, 1e-15);
  }
  assert_true(distance(exp_so3(Vector3::Zero()), kIdentity) == 0.0);
}

void the_logarithm_takes_back_the_exponential_to_rounding(void**) {
  RandomVectors random;
  for (const double angle : kAngles) {
    if (angle > 3.0) continue;
    for (int i = 0; i < 100; ++i) {
      const Vector3 phi = angle * random.axis();
      assert_close(log_so3(exp_so3(phi)), phi, 1e-15 * angle + 1e-315);  // few digits below 1e-300
    }
  }
}

void next_to_half_a_turn_the_logarithm_is_exact(void**) {
  RandomVectors random;
  for (double less = 0.1; less > 1e-18; less *= 0.1) {
    const Vector3 axis = random.axis();
    assert_close(log_so3(exp_so3((kPi - less) * axis)), (kPi - less) * axis, 2e-15);
    if (less > 1e-14) {
      assert_close(log_so3(exp_so3((kPi + less) * axis)), (less - kPi) * axis, 2e-15);
    }
  }
}

void of_more_than_half_a_turn_the_logarithm_is_the_shorter_way_round(void**) {
  RandomVectors random;
  for (const double angle : {3.5, 5.0, 6.0, 2.0 * kPi - 1e-3, 2.0 * kPi - 1e-9}) {
    const Vector3 axis = random.axis();
    assert_close(log_so3(exp_so3(angle * axis)), (angle - 2.0 * kPi) * axis, 3e-15);
  }
  assert_close(log_so3(exp_so3({0.0, 0.0, 2.0 * kPi})), Vector3::Zero(), 1e-15);
}

void the_logarithm_is_that_of_quad_precision_and_never_beyond_pi(void**) {
  RandomVectors random;
  for (int i = 0; i < 20000; ++i) {
    const double small = std::pow(10.0, -9.0 * std::abs(random.unit()));
    Vector3 v = random.vector();
    double w = random.unit();
    (i % 2 ? w : v.x()) *= small;
    if (i % 4 == 0) v *= small;
    Eigen::Quaterniond r(w, v.x(), v.y(), v.z());
    r.normalize();
    const Quad x = r.x(), y = r.y(), z = r.z(), n = sqrtq(x * x + y * y + z * z);
    const Quad scale = 2 * atan2q(n, fabsq(r.w())) / n * (r.w() < 0.0 ? -1 : 1);
    const Vector3 exact(static_cast<double>(scale * x), static_cast<double>(scale * y),
                        static_cast<double>(scale * z));
    assert_close(log_so3(r), exact, 1e-15 * exact.norm());
    assert_true(log_so3(r).norm() <= kPi * (1.0 + 1e-15));
  }
}

void the_sign_of_the_quaternion_does_not_matter(void**) {
  RandomVectors random;
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Quaterniond r = exp_so3(3.0 * random.vector());
    assert_true(log_so3(r) == log_so3(negative(r)));
  }
  for (int i = 0; i < 3; ++i) {  // half a turn about each axis; w may be either zero
    const Vector3 axis = Vector3::Unit(i);
    for (const double w : {0.0, -0.0}) {
      for (const double sign : {1.0, -1.0}) {
        const Vector3 v = sign * axis;
        assert_close(log_so3({w, v.x(), v.y(), v.z()}), kPi * axis, 1e-15);
      }
    }
  }
  assert_true(log_so3(kIdentity).isZero(0.0) && log_so3(negative(kIdentity)).isZero(0.0));
}

void a_quaternion_nearly_unit_has_the_logarithm_of_its_direction(void**) {
  const Vector3 phi(0.3, -1.2, 0.8);
  for (const double size : {0.51, 0.999, 1.001, 1.99}) {
    Eigen::Quaterniond r = exp_so3(phi);
    r.coeffs() *= size;
    assert_close(log_so3(r), phi, 2e-15);
  }
}

void what_is_no_rotation_has_no_logarithm_and_no_exponential(void**) {
  for (const double bad : {kNaN, kInfinity, -kInfinity, 1e200, 3.0}) {
    for (int i = 0; i < 4; ++i) {
      Eigen::Quaterniond r = kIdentity;
      r.coeffs()[i] = bad;
      assert_true(log_so3(r).array().isNaN().all());
    }
  }
  for (const double size : {0.0, 1e-200, 0.49}) {
    assert_true(log_so3({size, 0.0, 0.0, 0.0}).array().isNaN().all());
  }
  for (const double bad : {kNaN, kInfinity, -kInfinity, 1e200, 3.0 * kSinCosMax_rad}) {
    for (int i = 0; i < 3; ++i) {
      Vector3 phi(0.1, 0.2, 0.3);
      phi[i] = bad;
      assert_true(exp_so3(phi).coeffs().array().isNaN().all());
      const RightJacobian j(phi);
      assert_true(j.matrix().array().isNaN().all());
      const Vector3 one = Vector3::Ones();
      for (const Vector3& v :
           {j.inverse_times(one), j.rate_times(one, one), j.rates(one, one, one).ddw})
        assert_true(v.array().isNaN().all());
    }
  }
}

void the_right_jacobian_gives_the_angular_velocity_in_the_rotated_frame(void**) {
  RandomVectors random;
  for (const double angle : kAngles) {
    for (int i = 0; i < 20; ++i) {
      const Vector3 phi = angle * random.axis(), dphi = random.vector();
      const auto along = [&](double t) { return exp_so3(phi + t * dphi).coeffs(); };
      const Eigen::Quaterniond rate(Eigen::Vector4d(first_derivative(along, 0.03)));
      const Vector3 omega = 2.0 * (exp_so3(phi).conjugate() * rate).vec();
      assert_close(RightJacobian(phi).times(dphi), omega, 2e-13 * (1.0 + angle));
      assert_close(RightJacobian(phi).matrix() * dphi, RightJacobian(phi).times(dphi), 1e-15);
    }
  }
}

void the_inverse_takes_back_the_right_jacobian(void**) {
  RandomVectors random;
  for (const double angle : kAngles) {
    if (angle > 6.0) continue;
    for (int i = 0; i < 20; ++i) {
      const Vector3 v = random.vector();
      const RightJacobian j(angle * random.axis());
      assert_close(j.inverse_times(j.times(v)), v, angle < 4.0 ? 4e-15 : 2e-13);
      assert_close(j.times(j.inverse_times(v)), v, angle < 4.0 ? 4e-15 : 2e-13);
    }
  }
}

void the_rate_of_the_right_jacobian_is_its_derivative_in_time(void**) {
  RandomVectors random;
  for (const double angle : kAngles) {
    for (int i = 0; i < 20; ++i) {
      const Vector3 phi = angle * random.axis(), dphi = random.vector(), v = random.vector();
      const auto along = [&](double t) { return RightJacobian(phi + t * dphi).times(v); };
      assert_close(RightJacobian(phi).rate_times(dphi, v), first_derivative(along, 0.03),
                   2e-13 * (1.0 + angle));
    }
  }
}

void the_rates_are_the_derivatives_of_the_angular_velocity(void**) {
  RandomVectors random;
  for (int i = 0; i < 20; ++i) {
    for (const double angle : kAngles) {
      const Vector3 phi = angle * random.axis();
      const Vector3 dphi = random.vector(), ddphi = random.vector(), dddphi = random.vector();
      const auto alpha = [&](double t) -> Vector3 {
        const Vector3 rate = dphi + t * ddphi + t * t / 2.0 * dddphi;
        const RightJacobian j(phi + t * dphi + t * t / 2.0 * ddphi + t * t * t / 6.0 * dddphi);
        return j.times(ddphi + t * dddphi) + j.rate_times(rate, rate);
      };
      const auto rates = RightJacobian(phi).rates(dphi, ddphi, dddphi);
      assert_close(rates.dw, alpha(0.0), 1e-14 * (1.0 + angle));
      assert_close(rates.ddw, first_derivative(alpha, 0.02), 1e-12 * (1.0 + angle));
    }
  }
}

void about_a_fixed_axis_the_angular_velocity_is_the_rate_itself(void**) {
  for (const double angle : kAngles) {
    const Vector3 axis(0.6, 0.0, -0.8);
    const RightJacobian j(angle * axis);
    assert_close(j.times(2.0 * axis), 2.0 * axis, 1e-15 * (1.0 + angle));
    assert_close(j.rate_times(2.0 * axis, 2.0 * axis), Vector3::Zero(), 1e-14);
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_stumpff_functions_are_those_of_quad_precision),
      cmocka_unit_test(the_exponential_is_eigens_rotation_about_the_axis),
      cmocka_unit_test(the_logarithm_takes_back_the_exponential_to_rounding),
      cmocka_unit_test(next_to_half_a_turn_the_logarithm_is_exact),
      cmocka_unit_test(of_more_than_half_a_turn_the_logarithm_is_the_shorter_way_round),
      cmocka_unit_test(the_logarithm_is_that_of_quad_precision_and_never_beyond_pi),
      cmocka_unit_test(the_sign_of_the_quaternion_does_not_matter),
      cmocka_unit_test(a_quaternion_nearly_unit_has_the_logarithm_of_its_direction),
      cmocka_unit_test(what_is_no_rotation_has_no_logarithm_and_no_exponential),
      cmocka_unit_test(the_right_jacobian_gives_the_angular_velocity_in_the_rotated_frame),
      cmocka_unit_test(the_inverse_takes_back_the_right_jacobian),
      cmocka_unit_test(the_rate_of_the_right_jacobian_is_its_derivative_in_time),
      cmocka_unit_test(the_rates_are_the_derivatives_of_the_angular_velocity),
      cmocka_unit_test(about_a_fixed_axis_the_angular_velocity_is_the_rate_itself),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
