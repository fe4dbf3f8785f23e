// Rotation segments: the values at their ends, velocity and acceleration as derivatives of the
// orientation, and NaN for bad input, over seeded ends and over hard ones.
// The bounds of a rotation segment: no dense sample exceeds them, and they are close to the
// samples.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "kernel/math/so3.hpp"
#include "kernel/reference/space/rotation_segment.hpp"
#include "tests/support/rotation_cases.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const double kNaN = std::nan("");
constexpr double kRate = 3.0;  ///< of the ends, in radians per duration about each axis

double angle_between(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  return log_so3(a.conjugate() * b).norm();
}

bool all_nan(const RotationBoundary& b) {
  return b.r.coeffs().array().isNaN().all() && b.w.array().isNaN().all() &&
         b.alpha.array().isNaN().all();
}

bool all_nan(const VectorBounds& b) {
  return std::isnan(b.v) && std::isnan(b.a) && std::isnan(b.j);
}

// Proves RG-10.

void both_ends_are_met_in_all_that_the_order_joins(void**) {
  over_ends(kRate, [](const Ends& ends) {
    for (const Order order : kOrders) {
      const RotationSegment segment = ends.join(order);
      const double rate = 1e-12 / ends.T;
      for (const bool last : {false, true}) {
        const RotationBoundary now = segment.at(last ? ends.T : 0.0);
        const RotationBoundary& end = last ? ends.to : ends.from;
        ASSERT_NEAR(angle_between(now.r, end.r), 0.0, 1e-12);
        if (order != Order::kLinear) assert_close(now.w, end.w, rate);
        if (order == Order::kQuintic) assert_close(now.alpha, end.alpha, 20.0 * rate / ends.T);
      }
    }
  });
}

void velocity_and_acceleration_are_the_derivatives_of_the_orientation(void**) {
  over_segments(kRate, [](const RotationSegment& segment) {
    const VectorBounds most = segment.bounds();
    const double T = segment.duration();
    const double fastest = std::max({most.v, std::sqrt(most.a), 10.0 / T});  // 1/s
    const double h = 0.05 / fastest;
    for (const double share : {0.01, 0.2, 0.37, 0.5, 0.71, 0.99}) {
      const double t = 4.0 * h + share * (T - 8.0 * h);
      const RotationBoundary now = segment.at(t);
      const auto r = [&](double dt) -> Eigen::Vector4d { return segment.at(t + dt).r.coeffs(); };
      const auto w = [&](double dt) { return segment.at(t + dt).w; };
      const Eigen::Quaterniond dr(Eigen::Vector4d(first_derivative(r, h)));
      const Eigen::Quaterniond ddr(Eigen::Vector4d(second_derivative(r, h)));
      // r' = w r / 2 and r'' = (alpha r + w r') / 2, where w w is a real number.
      assert_close(2.0 * (dr * now.r.conjugate()).vec(), now.w, 1e-10 * fastest);
      assert_close(2.0 * (ddr * now.r.conjugate()).vec(), now.alpha, 1e-9 * fastest * fastest);
      assert_close(first_derivative(w, h), now.alpha, 1e-9 * fastest * fastest);
    }
  });
}

void linear_is_eigens_slerp_at_constant_velocity(void**) {
  over_ends(kRate, [](const Ends& ends) {
    const RotationSegment segment = ends.join(Order::kLinear);
    const double turned = angle_between(ends.from.r, ends.to.r);
    const Vector3 w = segment.at(0.0).w;
    ASSERT_NEAR(w.norm() * ends.T, turned, 1e-14);
    for (double share = 0.0; share <= 1.0; share += 0.125) {
      const RotationBoundary now = segment.at(share * ends.T);
      assert_close(now.w, w, 1e-14 / ends.T);
      assert_close(now.alpha, Vector3::Zero(), 1e-14 / (ends.T * ends.T));
      if (turned < kPi - 1e-6) {  // for half a turn both directions are right
        ASSERT_NEAR(angle_between(now.r, ends.from.r.slerp(share, ends.to.r)), 0.0, 3e-15);
      }
    }
  });
}

void from_rest_to_rest_the_shortest_arc_is_taken_in_every_order(void**) {
  over_ends(0.0, [](const Ends& ends) {
    const double turned = angle_between(ends.from.r, ends.to.r);
    for (const Order order : kOrders) {
      const RotationSegment segment = ends.join(order);
      for (const double share : {0.1, 0.4, 0.7, 1.0}) {
        const Eigen::Quaterniond r = segment.at(share * ends.T).r;
        const double gone = angle_between(ends.from.r, r), left = angle_between(r, ends.to.r);
        ASSERT_NEAR(gone + left, turned, 1e-13);
      }
    }
  });
}

void the_orientation_is_unit_and_never_jumps_its_sign(void**) {
  over_ends(kRate, [](const Ends& ends) {
    for (const Order order : kOrders) {
      for (const Eigen::Quaterniond& to : {ends.to.r, negative(ends.to.r)}) {
        Ends signed_ends = ends;
        signed_ends.to.r = to;
        const RotationSegment segment = signed_ends.join(order);
        Eigen::Quaterniond last = ends.from.r;
        for (int k = 0; k <= 200; ++k) {
          const Eigen::Quaterniond r = segment.at(ends.T * k / 200).r;
          ASSERT_NEAR(r.norm(), 1.0, 2e-15);
          assert_true(k > 0 ? r.dot(last) > 0.9 : distance(r, last) < 1e-15);
          last = r;
        }
      }
    }
  });
}

void the_sign_of_the_last_end_does_not_matter(void**) {
  over_ends(kRate, [](const Ends& ends) {
    Ends other = ends;
    other.to.r = negative(ends.to.r);
    const double t = 0.4 * ends.T;
    for (const Order order : kOrders) {
      assert_true(ends.join(order).at(t).r.coeffs() == other.join(order).at(t).r.coeffs());
    }
  });
}

void turned_ends_make_the_same_motion_turned(void**) {
  RandomVectors random;
  over_ends(kRate, [&random](const Ends& ends) {
    // For half a turn both directions are right.
    if (angle_between(ends.from.r, ends.to.r) > kPi - 1e-3) return;
    const Eigen::Quaterniond turn = exp_so3(3.0 * random.vector());
    Ends turned = ends;
    for (RotationBoundary* end : {&turned.from, &turned.to}) {
      *end = {turn * end->r, turn * end->w, turn * end->alpha};
    }
    const double t = 0.3 * ends.T, scale = 1e-11 / ends.T;
    const RotationBoundary a = ends.join(Order::kQuintic).at(t);
    const RotationBoundary b = turned.join(Order::kQuintic).at(t);
    ASSERT_NEAR(distance(turn * a.r, b.r), 0.0, 1e-11);
    assert_close(b.w, turn * a.w, scale);
    assert_close(b.alpha, turn * a.alpha, scale / ends.T);
  });
}

void a_number_that_is_not_finite_makes_every_result_nan(void**) {
  RandomVectors random;
  const Ends good = random_ends(random, 6, kRate);
  for (const double bad : {kNaN, kInfinity, -kInfinity}) {
    for (int i = 0; i < 20; ++i) {
      Ends ends = good;
      RotationBoundary& end = i < 10 ? ends.from : ends.to;
      const int k = i % 10;
      (k < 4 ? end.r.coeffs()[k] : k < 7 ? end.w[k - 4] : end.alpha[k - 7]) = bad;
      for (const Order order : kOrders) {
        if ((k >= 4 && order == Order::kLinear) || (k >= 7 && order == Order::kCubic)) continue;
        const RotationSegment segment = ends.join(order);
        for (const double share : {0.0, 0.3, 1.0}) {
          assert_true(all_nan(segment.at(share * ends.T)));
        }
        assert_true(all_nan(segment.bounds()));
      }
    }
  }
  for (const Order order : kOrders) assert_true(all_nan(good.join(order).at(kNaN)));
}

void a_segment_of_too_many_turns_has_neither_orientation_nor_bounds(void**) {
  Ends ends;
  ends.from.w = {1e7, 0.0, 0.0};  // rad/s: 160000 turns in between, none at the ends
  const RotationSegment segment = ends.join(Order::kCubic);
  assert_true(!all_nan(segment.at(0.0)) && all_nan(segment.at(0.3)));
  assert_true(all_nan(segment.bounds()));
}

void a_quaternion_far_from_unit_makes_every_result_nan(void**) {
  for (const double size : {0.0, 0.2, 5.0}) {
    Ends ends;
    ends.to.r = {size, 0.0, 0.0, 0.0};
    assert_true(all_nan(ends.join(Order::kLinear).at(0.5)));
    std::swap(ends.from, ends.to);
    assert_true(all_nan(ends.join(Order::kLinear).at(0.5)));
  }
}

/// Returns the largest values at many times; the jerk is the difference quotient of alpha.
VectorBounds sampled(const RotationSegment& segment) {
  constexpr int kSamples = 1000;
  const double T = segment.duration();
  VectorBounds most = {0.0, 0.0, 0.0};
  for (int k = 0; k <= kSamples; ++k) {
    const RotationBoundary now = segment.at(T * k / kSamples);
    most.v = std::max(most.v, now.w.norm());
    most.a = std::max(most.a, now.alpha.norm());
  }
  const double h = 0.01 / std::max({most.v, std::sqrt(most.a), 20.0 / T});
  for (int k = 0; k <= kSamples; ++k) {
    const double t = 4.0 * h + (T - 8.0 * h) * k / kSamples;
    const auto alpha = [&](double dt) { return segment.at(t + dt).alpha; };
    most.j = std::max(most.j, first_derivative(alpha, h).norm());
  }
  return most;
}

// Proves RG-6, RG-10.

void no_velocity_acceleration_or_jerk_is_beyond_the_bounds(void**) {
  for (const double rate : {0.0, kRate, 30.0, 300.0}) {
    over_segments(rate, [rate](const RotationSegment& segment) {
      const VectorBounds seen = sampled(segment);
      const double rounding = 1e-13 * (1.0 + rate) / segment.duration();
      const double faster = 10.0 * (1.0 + rate) / segment.duration();
      for (const Accuracy accuracy : {Accuracy::kQuick, Accuracy::kClose, Accuracy::kFine}) {
        const VectorBounds most = segment.bounds(accuracy);
        assert_true(seen.v <= most.v + rounding);
        assert_true(seen.a <= most.a + faster * rounding);
        assert_true(seen.j <= most.j + 100.0 * faster * faster * rounding);
      }
    });
  }
}

/// Returns the largest ratios of bounds to samples.
VectorBounds looseness(double rate, Accuracy accuracy) {
  VectorBounds worst = {1.0, 1.0, 1.0};
  over_segments(rate, [&worst, accuracy](const RotationSegment& segment) {
    const VectorBounds most = segment.bounds(accuracy), seen = sampled(segment);
    const double T = segment.duration();
    if (seen.v * T > 1e-6) worst.v = std::max(worst.v, most.v / seen.v);
    if (seen.a * T * T > 1e-6) worst.a = std::max(worst.a, most.a / seen.a);
    if (seen.j * T * T * T > 1e-6) worst.j = std::max(worst.j, most.j / seen.j);
  });
  print_message("rate %g: bounds at most %.3f (w) %.3f (alpha) %.3f (jerk) times what occurs\n",
                rate, worst.v, worst.a, worst.j);
  return worst;
}

void the_bounds_are_close(void**) {
  const VectorBounds rest = looseness(0.0, Accuracy::kFine),
                     moving = looseness(kRate, Accuracy::kFine);
  assert_true(rest.v < 1.02 && rest.a < 1.02 && rest.j < 1.05);
  assert_true(moving.v < 1.02 && moving.a < 1.05 && moving.j < 1.15);
  const VectorBounds at_rest = looseness(0.0, Accuracy::kClose),
                     in_motion = looseness(kRate, Accuracy::kClose);
  assert_true(at_rest.v < 1.02 && at_rest.a < 1.05 && at_rest.j < 1.12);
  assert_true(in_motion.v < 1.05 && in_motion.a < 1.2 && in_motion.j < 1.4);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(both_ends_are_met_in_all_that_the_order_joins),
      cmocka_unit_test(velocity_and_acceleration_are_the_derivatives_of_the_orientation),
      cmocka_unit_test(linear_is_eigens_slerp_at_constant_velocity),
      cmocka_unit_test(from_rest_to_rest_the_shortest_arc_is_taken_in_every_order),
      cmocka_unit_test(the_orientation_is_unit_and_never_jumps_its_sign),
      cmocka_unit_test(the_sign_of_the_last_end_does_not_matter),
      cmocka_unit_test(turned_ends_make_the_same_motion_turned),
      cmocka_unit_test(a_number_that_is_not_finite_makes_every_result_nan),
      cmocka_unit_test(a_segment_of_too_many_turns_has_neither_orientation_nor_bounds),
      cmocka_unit_test(a_quaternion_far_from_unit_makes_every_result_nan),
      cmocka_unit_test(no_velocity_acceleration_or_jerk_is_beyond_the_bounds),
      cmocka_unit_test(the_bounds_are_close),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
