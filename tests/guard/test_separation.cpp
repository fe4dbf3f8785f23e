// Tests the separation of two shapes against FCL and against a search along the segment: shapes are
// proved apart if they are, and only then.
#include "kernel/guard/separation.hpp"

#include <Eigen/Geometry>
#include <random>

#include "tests/oracles/fcl/fcl.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr double kFclClose = 1e-4, kClose = 1e-8;  // m

constexpr FclPlace kBase = {{0.0, 0.0, 0.0}, {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};

void put_nan(void* object, std::size_t number) {
  static_cast<double*>(object)[number] = std::nan("");
}

struct Shapes {
  std::mt19937_64 random{7};

  double unit() { return std::uniform_real_distribution<double>(-1.0, 1.0)(random); }
  Vector3 vector() { return {unit(), unit(), unit()}; }
  Capsule capsule() {
    const Vector3 a = 0.6 * vector();
    return {a, a + 0.4 * vector(), 0.02 + 0.08 * std::abs(unit())};
  }
  /// Parallel to a direction but for 1 to 1e-15, or without length.
  Capsule along(const Vector3& direction) {
    const double tilt = std::pow(10.0, -7.5 + 7.5 * unit()), length = unit() > 0.9 ? 0.0 : unit();
    const Vector3 a = 0.6 * vector();
    return {a, a + length * (direction + tilt * vector()), 0.02 + 0.08 * std::abs(unit())};
  }
  BoxShape box() {
    const Eigen::Quaterniond r(unit(), unit(), unit(), unit());
    return {r.normalized().toRotationMatrix(), 0.6 * vector(),
            Vector3::Constant(0.02) + 0.4 * vector().cwiseAbs()};
  }
};

FclCapsule fcl(const Capsule& c) {
  const Vector3 m = 0.5 * (c.a + c.b), along = c.b - c.a;
  return {{m[0], m[1], m[2]}, {along[0], along[1], along[2]}, c.radius, along.norm()};
}

double distance(const Capsule& one, const Capsule& other) {
  return fcl_distance(fcl(one), kBase, fcl(other), kBase);
}

double distance(const Capsule& one, const BoxShape& box) {
  FclPlace at;
  for (int i = 0; i < 3; ++i) {
    at.p[i] = box.centre[i];
    for (int j = 0; j < 3; ++j) at.r[i][j] = box.r(i, j);
  }
  return fcl_distance(fcl(one), kBase, FclBox{{2 * box.half[0], 2 * box.half[1], 2 * box.half[2]}},
                      at);
}

/// Returns the smallest of a convex function of 0 <= t <= 1.
template <class Function>
long double smallest(Function function) {
  long double low = 0.0L, high = 1.0L;
  for (int k = 0; k < 150; ++k) {
    const long double third = (high - low) / 3.0L;
    if (function(low + third) < function(high - third))
      high -= third;
    else
      low += third;
  }
  return std::min({function(low), function(0.0L), function(1.0L)});
}

using Long3 = Eigen::Matrix<long double, 3, 1>;

Long3 point(const Capsule& c, long double t) {
  return c.a.cast<long double>() + t * (c.b - c.a).cast<long double>();
}

/// Return the distance by search along the segment, to within rounding; not below zero before the
/// radii are taken off.
long double searched(const Capsule& one, const Capsule& other) {
  const Long3 d = (other.b - other.a).cast<long double>();
  const long double square = smallest([&](long double t) {
    const Long3 r = point(one, t) - other.a.cast<long double>();
    const long double part = d.squaredNorm() > 0.0L ? r.dot(d) / d.squaredNorm() : 0.0L;
    return (r - std::clamp(part, 0.0L, 1.0L) * d).squaredNorm();
  });
  return std::sqrt(square) - one.radius - other.radius;
}

long double searched(const Capsule& one, const BoxShape& box) {
  const long double square = smallest([&](long double t) {
    const Long3 centre = box.centre.cast<long double>(), half = box.half.cast<long double>();
    const Long3 r = box.r.cast<long double>().transpose() * (point(one, t) - centre);
    return (r.cwiseAbs() - half).cwiseMax(Long3::Zero()).squaredNorm();
  });
  return std::sqrt(square) - one.radius;
}

/// The verdict changes where the margin is the distance, by the search and, as far as it is exact,
/// by FCL.
template <class Other>
void compare(const Capsule& one, const Other& other, int& clear, int& met) {
  const auto gap = static_cast<double>(searched(one, other));
  const double by_fcl = distance(one, other);
  if (gap <= 0.0) {
    assert_false(separation(one, other) > 0.0);
    assert_true(by_fcl <= kFclClose);
    ++met;
    return;
  }
  assert_false(separation(one, other) > gap + kClose ||
               separation(one, other) > by_fcl + kFclClose);
  if (gap > kClose) assert_true(separation(one, other) > gap - kClose);
  if (by_fcl > kFclClose) assert_true(separation(one, other) > by_fcl - kFclClose);
  ++clear;
}

// Proves COL-1, COL-2.

/// The margin at which the verdict changes is the distance.
void shapes_are_apart_by_their_distance_and_no_more(void**) {
  Shapes shapes;
  int clear = 0, met = 0, clear_of_box = 0, met_box = 0;
  for (int i = 0; i < 20000; ++i) {
    const Capsule one = shapes.capsule();
    const BoxShape box = shapes.box();
    compare(one, shapes.capsule(), clear, met);
    compare(one, shapes.along(one.b - one.a), clear, met);
    compare(one, box, clear_of_box, met_box);
    compare(shapes.along(box.r.col(i % 3)), box, clear_of_box, met_box);
  }
  print_message("capsules: %d apart, %d meet; boxes: %d, %d\n", clear, met, clear_of_box, met_box);
  assert_true(clear > 20000 && met > 500 && clear_of_box > 10000 && met_box > 2000);
}

/// Parallel, on one line, crossing, without length, about one centre, on a face.
void degenerate_shapes_are_no_exception(void**) {
  const Vector3 o = Vector3::Zero(), x = Vector3::UnitX(), y = Vector3::UnitY(),
                z = Vector3::UnitZ();
  const Capsule along = {-x, x, 0.1}, point = {o, o, 0.1};
  const BoxShape box = {Matrix3::Identity(), o, {0.5, 0.5, 0.5}};
  for (const double gap : {-0.3, -1e-3, -1e-9, 1e-9, 1e-3, 0.1, 1.0}) {
    const bool clear = gap > 0.0;
    const Vector3 up = (0.2 + gap) * z, beside = (0.6 + gap) * y;
    assert_int_equal(separation(along, Capsule{up - x, up + x, 0.1}) > 0.0, clear);
    assert_int_equal(separation(along, Capsule{up - y, up + y, 0.1}) > 0.0, clear);
    assert_int_equal(separation(along, Capsule{x + (0.2 + gap) * x, 3.0 * x, 0.1}) > 0.0, clear);
    assert_int_equal(separation(point, Capsule{up, up, 0.1}) > 0.0, clear);
    assert_int_equal(separation(Capsule{beside, beside, 0.1}, box) > 0.0, clear);
    assert_int_equal(separation(Capsule{beside - x, beside + x, 0.1}, box) > 0.0, clear);
  }
  assert_false(separation(along, along) > 0.0);
  assert_false(separation(point, point) > 0.0);
  assert_false(separation(point, box) > 0.0);
}

// Proves COL-4.

/// Puts NaN in place of every number of two shapes that are far apart.
template <class Other>
void assert_nan_is_no_proof(const Capsule& one, const Other& other) {
  static_assert(sizeof one % sizeof(double) == 0 && sizeof other % sizeof(double) == 0);
  assert_true(separation(one, other) > 0.0);
  Capsule bad = one;
  for (std::size_t i = 0; i < sizeof bad / sizeof(double); ++i, bad = one) {
    put_nan(&bad, i);
    assert_false(separation(bad, other) > 0.0);
  }
  Other bad_other = other;
  for (std::size_t i = 0; i < sizeof bad_other / sizeof(double); ++i, bad_other = other) {
    put_nan(&bad_other, i);
    assert_false(separation(one, bad_other) > 0.0);
  }
  for (const double margin : {std::nan(""), HUGE_VAL})
    assert_false(separation(one, other) > margin);
}

void what_is_not_a_number_is_not_apart(void**) {
  const Vector3 far = {5.0, 6.0, 7.0}, on = {0.5, -0.2, 0.1}, o = Vector3::Zero();
  const Capsule here = {o, on, 0.1}, point = {o, o, 0.1};
  for (const Capsule& one : {here, point}) {
    assert_nan_is_no_proof(one, Capsule{far, far + on, 0.1});
    assert_nan_is_no_proof(one, Capsule{far, far, 0.1});
    assert_nan_is_no_proof(one, BoxShape{Matrix3::Identity(), far, {0.5, 0.5, 0.5}});
    assert_nan_is_no_proof(one, BoxShape{Shapes().box().r, far, {0.5, 0.5, 0.5}});
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(shapes_are_apart_by_their_distance_and_no_more),
      cmocka_unit_test(degenerate_shapes_are_no_exception),
      cmocka_unit_test(what_is_not_a_number_is_not_apart),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
