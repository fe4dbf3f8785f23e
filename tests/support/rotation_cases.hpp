// Shared by the tests of rotations: seeded numbers and segments, distances, and finite differences.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <random>

#include "kernel/math/so3.hpp"
#include "kernel/reference/space/rotation_segment.hpp"
#include "tests/support/testing.hpp"
#include "tests/support/trials.hpp"

namespace tactus {

constexpr double kPi = 3.14159265358979323846;
constexpr unsigned kSeed = 20260410;
inline const Eigen::Quaterniond kIdentity(1.0, 0.0, 0.0, 0.0);

struct RandomVectors {
  std::mt19937_64 bits{kSeed};
  double unit() { return std::uniform_real_distribution<double>(-1.0, 1.0)(bits); }
  double between(double a, double b) { return a + 0.5 * (1.0 + unit()) * (b - a); }
  Vector3 vector() { return {unit(), unit(), unit()}; }
  Vector3 axis() { return (vector() + Vector3(1e-3, 0.0, 0.0)).normalized(); }
};

inline Eigen::Quaterniond negative(const Eigen::Quaterniond& r) {
  return {-r.w(), -r.x(), -r.y(), -r.z()};
}

/// Returns the distance of two quaternions, not of their rotations: r and -r are apart.
inline double distance(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  return (a.coeffs() - b.coeffs()).norm();
}

inline void assert_close(const Vector3& actual, const Vector3& expected, double tolerance) {
  ASSERT_NEAR((actual - expected).norm(), 0.0, tolerance);
}

/// Returns the first derivative of a function at zero, by central differences of eighth order with
/// the step h.
template <class Function>
auto first_derivative(Function f, double h) {
  return (((4.0 / 5.0) * (f(h) - f(-h)) - (1.0 / 5.0) * (f(2.0 * h) - f(-2.0 * h)) +
           (4.0 / 105.0) * (f(3.0 * h) - f(-3.0 * h)) -
           (1.0 / 280.0) * (f(4.0 * h) - f(-4.0 * h))) /
          h)
      .eval();
}

/// Returns the second derivative in the same way.
template <class Function>
auto second_derivative(Function f, double h) {
  return (((8.0 / 5.0) * (f(h) + f(-h)) - (1.0 / 5.0) * (f(2.0 * h) + f(-2.0 * h)) +
           (8.0 / 315.0) * (f(3.0 * h) + f(-3.0 * h)) - (1.0 / 560.0) * (f(4.0 * h) + f(-4.0 * h)) -
           (205.0 / 72.0) * f(0.0)) /
          (h * h))
      .eval();
}

using Order = RotationSegment::Order;
inline constexpr std::array<Order, 3> kOrders = {Order::kLinear, Order::kCubic, Order::kQuintic};

/// Ends of a segment, and its duration.
struct Ends {
  RotationBoundary from, to;
  double T = 1.0;
  RotationSegment join(Order order) const { return RotationSegment(from, to, T, order); }
};

/// Returns a turn between two ends: any, or one whose shortest arc is hard to find or very short.
inline Eigen::Quaterniond hard_turn(RandomVectors& random, int kind) {
  const Vector3 axis = random.axis();
  switch (kind % 8) {
    case 0: return kIdentity;
    case 1: return negative(kIdentity);
    case 2: return exp_so3(kPi * axis);
    case 3: return exp_so3((kPi + 1e-9 * random.unit()) * axis);
    case 4: return exp_so3((2.0 * kPi - 1e-3) * axis);
    case 5: return negative(exp_so3(1e-9 * axis));
    default: return exp_so3(random.between(0.0, 2.0 * kPi) * axis);
  }
}

/// Returns ends that turn at up to `rate` radians per duration about each axis.
inline Ends random_ends(RandomVectors& random, int kind, double rate) {
  Ends ends;
  ends.T = std::pow(10.0, random.unit());
  ends.from.r = exp_so3(kPi * random.vector());
  ends.to.r = ends.from.r * hard_turn(random, kind);
  for (RotationBoundary* end : {&ends.from, &ends.to}) {
    end->w = rate / ends.T * random.vector();
    end->alpha = 3.0 * rate / (ends.T * ends.T) * random.vector();
  }
  return ends;
}

/// Calls check(ends) for random ends of every kind, the same in every run.
template <class Check>
void over_ends(double rate, Check check) {
  constexpr int kCases = tries(200, 40);  // of eight kinds
  RandomVectors random;
  for (int i = 0; i < kCases; ++i) check(random_ends(random, i, rate));
}

template <class Check>
void over_segments(double rate, Check check) {
  over_ends(rate, [&](const Ends& ends) {
    for (const Order order : kOrders) check(ends.join(order));
  });
}

}  // namespace tactus
