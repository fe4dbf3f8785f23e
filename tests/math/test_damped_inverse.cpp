// Tests the damped inverse on Jacobians built from known singular values, J = U diag(s) V^T, for
// which J# = V diag(s / (s^2 + lambda^2)) U^T. The arms have six and seven joints.
#include "kernel/math/damped_inverse.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "tests/support/rotation_cases.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr double kOnset = 0.05;

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Six orthonormal columns of n numbers, by Gram-Schmidt, applied twice for accuracy.
template <int n>
Eigen::Matrix<double, n, 6> orthonormal(RandomVectors& random) {
  Eigen::Matrix<double, n, 6> m;
  for (int c = 0; c < 6; ++c) {
    for (int r = 0; r < n; ++r) m(r, c) = random.unit();
    for (int round = 0; round < 2; ++round) {
      for (int k = 0; k < c; ++k) m.col(c) -= m.col(k).dot(m.col(c)) * m.col(k);
      m.col(c).normalize();
    }
  }
  return m;
}

template <int n>
struct Known {
  Eigen::Matrix<double, 6, 6> U;
  Eigen::Matrix<double, n, 6> V;
  Vector6 s;

  Known(RandomVectors& random, const Vector6& values)
      : U(orthonormal<6>(random)), V(orthonormal<n>(random)), s(values) {}
  Eigen::Matrix<double, 6, n> J() const { return U * s.asDiagonal() * V.transpose(); }
  DampedInverse<n> inverse() const { return DampedInverse<n>(J(), kOnset); }
  /// The product by the closed form.
  Eigen::Matrix<double, n, 1> times(const Vector6& v, double lambda) const {
    const Vector6 gain = s.array() / (s.array().square() + lambda * lambda);
    return V * gain.asDiagonal() * U.transpose() * v;
  }
};

Vector6 random_six(RandomVectors& random) {
  Vector6 v;
  v << random.vector(), random.vector();
  return v;
}

/// Six singular values of an arm, the last of them given.
Vector6 values(RandomVectors& random, double last) {
  Vector6 s;
  for (int i = 0; i < 5; ++i) s[i] = random.between(0.3, 2.0);
  s[5] = last;
  return s;
}

template <class Check>
void over_arms(Check check) {
  RandomVectors random;
  for (int i = 0; i < 200; ++i) {
    check(random, std::integral_constant<int, 6>());
    check(random, std::integral_constant<int, 7>());
  }
}

// Proves CP-6.

void away_from_singularities_it_is_the_pseudoinverse(void**) {
  over_arms([](RandomVectors& random, auto n) {
    const Known<n()> known(random, values(random, random.between(0.06, 0.3)));
    const auto inverse = known.inverse();
    const Vector6 v = random_six(random);
    assert_true(inverse.lambda() == 0.0);
    ASSERT_NEAR((inverse.times(v) - known.times(v, 0.0)).norm(), 0.0, 1e-7);
    ASSERT_NEAR((known.J() * inverse.times(v) - v).norm(), 0.0, 1e-8);
  });
}

void sigma_is_one_over_the_frobenius_norm_of_the_pseudoinverse(void**) {
  over_arms([](RandomVectors& random, auto n) {
    const double last = std::pow(10.0, random.between(-3.0, -0.5));
    const Known<n()> known(random, values(random, last));
    const double expected = 1.0 / std::sqrt(known.s.array().square().inverse().sum());
    const double sigma = known.inverse().sigma();
    ASSERT_NEAR(sigma / expected, 1.0, 1e-5);
    assert_true(sigma <= last && last <= std::sqrt(6.0) * sigma * 1.00001);
  });
}

void below_the_onset_it_is_damped_by_what_is_missing(void**) {
  over_arms([](RandomVectors& random, auto n) {
    const Known<n()> known(random, values(random, random.between(0.0, 0.049)));
    const auto inverse = known.inverse();
    const Vector6 v = random_six(random);
    ASSERT_NEAR(inverse.lambda(), kOnset - inverse.sigma(), 1e-15);
    ASSERT_NEAR((inverse.times(v) - known.times(v, inverse.lambda())).norm(), 0.0, 1e-6);
  });
}

void damping_sets_in_without_a_step_or_a_kink(void**) {
  RandomVectors random;
  const Vector6 regular = values(random, 0.0);
  const auto squared = [&](double last) {
    RandomVectors again;
    Vector6 s = regular;
    s[5] = last;
    return std::pow(Known<7>(again, s).inverse().lambda(), 2);
  };
  constexpr double kStep = 1e-4;
  double before = squared(0.04), slope_before = 0.0;
  for (double last = 0.04 + kStep; last < 0.06; last += kStep) {
    const double now = squared(last), slope = (now - before) / kStep;
    assert_true(std::abs(now - before) < 3e-6);
    if (last > 0.04 + 1.5 * kStep) assert_true(std::abs(slope - slope_before) < 3.0 * kStep);
    before = now;
    slope_before = slope;
  }
  assert_true(before == 0.0 && squared(0.04) > 0.0);
}

void however_many_singular_values_vanish_it_stays_bounded(void**) {
  over_arms([](RandomVectors& random, auto n) {
    Vector6 s;
    for (int i = 0; i < 6; ++i)
      s[i] = random.unit() > 0.0 ? std::pow(10.0, random.between(-9.0, 0.0)) : 0.0;
    const Known<n()> known(random, s);
    const auto inverse = known.inverse();
    for (int i = 0; i < 6; ++i) {
      const double size = inverse.times(known.U.col(i)).norm();
      assert_true(size <= (1.0 + std::sqrt(2.0)) / (2.0 * kOnset) * (1.0 + 1e-6));
    }
  });
}

void what_is_in_the_null_space_does_not_move_the_task(void**) {
  over_arms([](RandomVectors& random, auto n) {
    Eigen::Matrix<double, n(), 1> dq;
    for (int i = 0; i < n(); ++i) dq[i] = random.unit();
    const Known<n()> known(random, values(random, random.between(0.1, 0.3)));
    const auto rest = known.inverse().null_space(dq);
    ASSERT_NEAR((known.J() * rest).norm(), 0.0, 1e-10);
    const auto kept = dq - known.V * (known.V.transpose() * dq);
    ASSERT_NEAR((rest - kept).norm(), 0.0, 1e-8);

    const Known<n()> singular(random, values(random, random.between(0.0, 0.04)));
    const auto inverse = singular.inverse();
    const double moved = (singular.J() * inverse.null_space(dq)).norm();
    assert_true(moved <= 0.05 * inverse.lambda() * dq.norm() + 1e-12);
  });
}

void a_column_of_zeros_leaves_its_joint_out(void**) {
  over_arms([](RandomVectors& random, auto n) {
    auto J = Known<n()>(random, values(random, 0.3)).J();
    J.col(2).setZero();
    const DampedInverse<n()> inverse(J, kOnset);
    const auto dq = inverse.times(random_six(random));
    assert_true(dq[2] == 0.0 && dq.allFinite());
  });
}

/// One joint after the other, against the formula by a general solver.
void joints_are_left_out_one_after_the_other(void**) {
  over_arms([](RandomVectors& random, auto n) {
    using Joints = Eigen::Matrix<double, n(), 1>;
    auto J = Known<n()>(random, values(random, random.between(0.01, 0.3))).J();
    const double floor = random.between(0.0, 0.02);
    DampedInverse<n()> inverse(J, kOnset, floor);
    for (int joints = n() - 1; joints > 0; --joints) {
      J.col(joints).setZero();
      inverse.leave_out(joints);
      const Matrix6 JJt = J * J.transpose();
      const double sigma = joints < 6 ? 0.0 : 1.0 / std::sqrt(JJt.inverse().trace());
      const double lambda = std::max(0.0, kOnset - sigma);
      const double lambda_c = std::sqrt(std::max(lambda * lambda, floor - sigma * sigma));
      const auto damped = [&](double by) {
        return Matrix6((JJt + by * by * Matrix6::Identity()).inverse());
      };
      ASSERT_NEAR(inverse.sigma(), sigma, 1e-7);
      ASSERT_NEAR(inverse.lambda(), lambda, 1e-7);
      const Vector6 v = random_six(random), correction = random_six(random);
      const Joints dq = J.transpose() * damped(lambda) * v;
      const Joints corrected = J.transpose() * damped(lambda_c) * correction;
      ASSERT_NEAR((inverse.times(v) - dq).norm(), 0.0, 1e-6);
      ASSERT_NEAR((inverse.correcting(correction) - corrected).norm(), 0.0, 1e-6);
      ASSERT_NEAR((inverse.times(v, correction) - dq - corrected).norm(), 0.0, 1e-6);
      const Joints rest = J.transpose() * v;
      const Joints moved = rest - J.transpose() * damped(lambda_c - 0.9 * lambda) * (J * rest);
      ASSERT_NEAR((inverse.null_space(rest) - moved).norm(), 0.0, 1e-6);
    }
  });
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(away_from_singularities_it_is_the_pseudoinverse),
      cmocka_unit_test(sigma_is_one_over_the_frobenius_norm_of_the_pseudoinverse),
      cmocka_unit_test(below_the_onset_it_is_damped_by_what_is_missing),
      cmocka_unit_test(damping_sets_in_without_a_step_or_a_kink),
      cmocka_unit_test(however_many_singular_values_vanish_it_stays_bounded),
      cmocka_unit_test(what_is_in_the_null_space_does_not_move_the_task),
      cmocka_unit_test(a_column_of_zeros_leaves_its_joint_out),
      cmocka_unit_test(joints_are_left_out_one_after_the_other),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
