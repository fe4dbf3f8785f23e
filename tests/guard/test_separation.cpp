// Tests the separation of two shapes against FCL: a proof of separation is never wrong, and
// separated shapes are proved so.
#include "kernel/guard/separation.hpp"

#include <Eigen/Geometry>
#include <random>

#include "tests/oracles/fcl/fcl.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr FclPlace kBase = {{0.0, 0.0, 0.0}, {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};

struct Shapes {
  std::mt19937_64 random{7};

  double unit() { return std::uniform_real_distribution<double>(-1.0, 1.0)(random); }
  Vector3 vector() { return {unit(), unit(), unit()}; }
  Capsule capsule() {
    const Vector3 a = 0.6 * vector();
    return {a, a + 0.4 * vector(), 0.02 + 0.08 * std::abs(unit())};
  }
  BoxShape box() {
    const Eigen::Quaterniond r(unit(), unit(), unit(), unit());
    return {r.normalized().toRotationMatrix(), 0.6 * vector(),
            Vector3::Constant(0.02) + 0.4 * vector().cwiseAbs()};
  }
};

FclCapsule fcl(const Capsule& c) {
  const Vector3 m = c.centre(), along = c.b - c.a;
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

struct Count {
  int apart = 0, met = 0, far = 0;
};

/// FCL gives no depth for shapes that overlap, only that they do.
template <class Other>
void compare(const Capsule& one, const Other& other, double inflation, Count& count) {
  const double gap = distance(one, other) - inflation;
  const Separation result = separate(one, other, inflation);
  assert_in_range(result.support_calls, 2, kSupportCallsOfPair);
  if (gap <= 0.0) {
    assert_false(result.proved);
    assert_false(far_apart(one, other, inflation));
    ++count.met;
  } else if (gap > 1e-4) {
    assert_true(result.proved);
    ++count.apart;
    count.far += far_apart(one, other, inflation);
  }
}

// Proves COL-1, COL-2, COL-6.

void capsules_and_boxes_are_apart_when_fcl_says_so(void**) {
  Shapes shapes;
  Count capsules, boxes;
  for (int i = 0; i < 20000; ++i) {
    const Capsule one = shapes.capsule();
    const double inflation = i % 3 * 0.05;
    compare(one, shapes.capsule(), inflation, capsules);
    compare(one, shapes.box(), inflation, boxes);
  }
  print_message("capsules: %d apart, %d of them far, %d meet; boxes: %d, %d, %d\n", capsules.apart,
                capsules.far, capsules.met, boxes.apart, boxes.far, boxes.met);
  assert_true(capsules.apart > 5000 && capsules.met > 500 && capsules.far > 3000);
  assert_true(boxes.apart > 2000 && boxes.met > 2000 && boxes.far > 100);
}

/// Parallel, on one line, crossing, without length, about one centre, on a face.
void degenerate_shapes_are_no_exception(void**) {
  const Vector3 o = Vector3::Zero(), x = Vector3::UnitX(), y = Vector3::UnitY(),
                z = Vector3::UnitZ();
  const Capsule along = {-x, x, 0.1}, point = {o, o, 0.1};
  const BoxShape box = {Matrix3::Identity(), o, {0.5, 0.5, 0.5}};
  for (const double gap : {-0.3, -1e-3, -1e-9, 0.0, 1e-3, 0.1, 1.0}) {
    const bool apart = gap > 0.0;
    const Vector3 up = (0.2 + gap) * z, beside = (0.6 + gap) * y;
    assert_int_equal(separate(along, Capsule{up - x, up + x, 0.1}, 0.0).proved, apart);
    assert_int_equal(separate(along, Capsule{up - y, up + y, 0.1}, 0.0).proved, apart);
    assert_int_equal(separate(along, Capsule{x + (0.2 + gap) * x, 3.0 * x, 0.1}, 0.0).proved,
                     apart);
    assert_int_equal(separate(point, Capsule{up, up, 0.1}, 0.0).proved, apart);
    assert_int_equal(separate(Capsule{beside, beside, 0.1}, box, 0.0).proved, apart);
    assert_int_equal(separate(Capsule{beside - x, beside + x, 0.1}, box, 0.0).proved, apart);
  }
  assert_false(separate(along, along, 0.0).proved);
  assert_false(separate(point, point, 0.0).proved);
  assert_false(separate(point, box, 0.0).proved);
}

// Proves COL-4.

void what_is_not_a_number_is_not_apart(void**) {
  const double nan = std::nan("");
  const Vector3 far = Vector3::Constant(5.0), bad = {5.0, nan, 5.0};
  const Capsule here = {Vector3::Zero(), Vector3::UnitX(), 0.1}, there = {far, far, 0.1};
  const BoxShape box = {Matrix3::Identity(), far, {0.5, 0.5, 0.5}};
  assert_true(separate(here, there, 0.0).proved && separate(here, box, 0.0).proved);
  const Capsule bad_end = {far, bad, 0.1}, bad_radius = {far, far, nan};
  for (const Capsule& capsule : {bad_end, bad_radius}) {
    assert_false(separate(here, capsule, 0.0).proved || far_apart(here, capsule, 0.0));
    assert_false(separate(capsule, here, 0.0).proved || far_apart(capsule, here, 0.0));
    assert_false(separate(capsule, BoxShape(), 0.0).proved || far_apart(capsule, BoxShape(), 0.0));
  }
  BoxShape bad_box = box;
  bad_box.centre = bad;
  assert_false(separate(here, bad_box, 0.0).proved || far_apart(here, bad_box, 0.0));
  bad_box = box;
  bad_box.r(0, 0) = nan;
  assert_false(separate(here, bad_box, 0.0).proved || far_apart(here, bad_box, 0.0));
  for (const double inflation : {nan, HUGE_VAL}) {
    assert_false(separate(here, there, inflation).proved || far_apart(here, there, inflation));
    assert_false(separate(here, box, inflation).proved || far_apart(here, box, inflation));
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(capsules_and_boxes_are_apart_when_fcl_says_so),
      cmocka_unit_test(degenerate_shapes_are_no_exception),
      cmocka_unit_test(what_is_not_a_number_is_not_apart),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
