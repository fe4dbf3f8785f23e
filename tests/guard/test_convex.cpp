// Tests the distance of convex bodies against a bracket of their true distance: what is proved is
// never more, and where more than what is wanted is there, it is nearly always found.
#include <Eigen/Geometry>

#include "kernel/guard/convex.hpp"
#include "tests/guard/convex_oracle.hpp"
#include "tests/support/random.hpp"
#include "tests/support/testing.hpp"
#include "tests/support/trials.hpp"

namespace tactus {
namespace {

using Core = Convex::Core;

/// A random body, of an arm's size or flat or without extent, with the hull that it needs.
struct Body {
  Hull hull;
  Solid solid;
  OracleBody oracle;

  void add(const Vector3& point) {
    Message why, text;
    for (int i = 0; i < 3; ++i) text.append(point[i], 9) << " ";
    assert_int_equal(static_cast<int>(hull.add(text, 1, why)), 0);
  }
};

struct Bodies {
  Random random{11};

  double unit() { return random.uniform(-1.0, 1.0); }
  Vector3 vector() { return {unit(), unit(), unit()}; }
  /// Most are at the axes or at right angles to them, or nearly.
  Matrix3 rotation() {
    Eigen::Quaterniond r(unit(), unit(), unit(), unit());
    if (random.below(2) == 0) {
      const double tilt = std::pow(10.0, random.uniform(-12.0, -3.0));
      r = Eigen::Quaterniond(random.below(2) == 0 ? 1.0 : 0.0, 0.0, random.below(2), tilt * unit());
      if (r.norm() < 0.5) r = Eigen::Quaterniond::Identity();
    }
    return r.normalized().toRotationMatrix();
  }
  double length() { return random.below(8) == 0 ? 0.0 : 0.3 * std::abs(unit()) + 1e-3; }

  void make(Body& body) {
    body = {};
    body.solid.r = rotation();
    body.solid.middle = 0.6 * vector();
    Convex& convex = body.solid.convex;
    convex.core = static_cast<Core>(random.below(4));
    convex.rounding = random.below(2) == 0 ? 0.0 : 0.05 * std::abs(unit());
    convex.half = {length(), length(), length()};
    if (convex.core == Core::kCylinder) convex.half.y() = convex.half.x();
    if (convex.core == Core::kHull) fill(body);
    describe(body);
  }

 private:
  void fill(Body& body) {
    const int count = 1 + random.below(Hull::kMost);
    const Vector3 extent = {length(), length(), length()};
    for (int i = 0; i < count; ++i) body.add(extent.cwiseProduct(vector()));
    body.solid.convex.take(body.hull);
  }
  /// The same body for the oracle, by its corners.
  static void describe(Body& body) {
    const Convex& convex = body.solid.convex;
    const Vector3& h = convex.half;
    std::vector<Vector3> corners;
    if (convex.core == Core::kSegment) corners = {h, -h};
    if (convex.core == Core::kCylinder) corners = {{0.0, 0.0, h.z()}, {0.0, 0.0, -h.z()}};
    for (int i = 0; i < 8 && convex.core == Core::kBox; ++i)
      corners.push_back(h.cwiseProduct(Vector3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
    for (int i = 0; i < body.hull.count(); ++i) corners.push_back(body.hull[i] - convex.middle);
    for (const Vector3& corner : corners)
      body.oracle.points.push_back(body.solid.middle + body.solid.r * corner);
    body.oracle.rounding = convex.rounding;
    body.oracle.normal = body.solid.r.col(2);
    body.oracle.radius = convex.core == Core::kCylinder ? h.x() : 0.0;
  }
};

void move(Body& body, const Vector3& way) {
  body.solid.middle += way;
  for (Vector3& point : body.oracle.points) point += way;
}

// Proves COL-12.

void no_distance_is_proved_that_is_not_there(void**) {
  static Body one, other;
  Bodies bodies;
  int meets = 0, easy = 0, missed = 0;
  const int count = trials(3000);
  for (int i = 0; i < count; ++i) {
    bodies.make(one);
    bodies.make(other);
    const Bracket before = bracket(one.oracle, other.oracle, 40);
    if (before.most > 0.0 && bodies.random.below(3) > 0)  // to near contact
      move(other, (1.0 - std::pow(10.0, bodies.random.uniform(-6.0, 0.0))) * 0.98 *
                      (one.solid.middle - other.solid.middle).normalized() * before.most);
    const Bracket gap = bracket(one.oracle, other.oracle);
    const double wanted = std::pow(10.0, bodies.random.uniform(-4.0, -0.5));
    int directions = 200;
    const double proved = separation(one.solid, other.solid, wanted, directions);
    assert_false(proved > gap.most + 1e-9);
    assert_in_range(directions, 200 - 16, 199);
    meets += gap.least <= 0.0;
    if (!(gap.least > wanted + 1e-3)) continue;
    ++easy;
    missed += !(proved > wanted);
  }
  print_message("%d pairs, %d that may meet; of %d a mm beyond what is wanted %d not proved\n",
                count, meets, easy, missed);
  assert_true(meets > count / 20 && easy > count / 4 && missed <= easy / 400);
}

void nan_and_used_up_directions_prove_nothing(void**) {
  static Body one, other;
  Bodies bodies;
  for (int i = 0; i < 200; ++i) {
    bodies.make(one);
    bodies.make(other);
    int directions = 0;
    assert_false(separation(one.solid, other.solid, 1e-3, directions) > -1.0);
    directions = 200;
    Solid bad = one.solid;
    if (i % 2 == 0)
      bad.middle[i % 3] = std::nan("");
    else
      bad.r.row(i % 3).setConstant(std::nan(""));
    assert_false(separation(bad, other.solid, 1e-3, directions) > -1.0);
  }
}

void a_point_of_a_hull_is_three_numbers_in_range(void**) {
  constexpr struct {
    const char *text, *why;
  } kCases[] = {{"1 2", "'1 2' is 2 numbers; a point is 3, m"},
                {"1 2 3,", "'' is 0 numbers"},
                {"1 2 3, 4 5", "'4 5' is 2 numbers"},
                {"1 2 3 4", "'4' is too much"},
                {"1 nan 3", "'nan' is not a finite number"},
                {"1 2 10.5", "10.5 m is out of range; it must be in [-10, 10]"}};
  for (const auto& each : kCases) {
    Hull hull;
    Message why;
    ASSERT_STATUS(hull.add(each.text, 1, why), Status::kBadValue);
    assert_non_null(std::strstr(why.c_str(), each.why));
  }
  Hull hull;
  Message why;
  ASSERT_OK(hull.add("1 2 3,4 5 6 , 7 8 -9e-1", 1, why));
  assert_true(hull.count() == 3 && hull[2] == Vector3(7.0, 8.0, -0.9));
  for (int i = 3; i < Hull::kMost; ++i) ASSERT_OK(hull.add("1 2 3", 1, why));
  ASSERT_STATUS(hull.add("1 2 3", 1, why), Status::kTooLarge);
  assert_non_null(std::strstr(why.c_str(), "more than 64 points"));
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(no_distance_is_proved_that_is_not_there),
      cmocka_unit_test(nan_and_used_up_directions_prove_nothing),
      cmocka_unit_test(a_point_of_a_hull_is_three_numbers_in_range),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
