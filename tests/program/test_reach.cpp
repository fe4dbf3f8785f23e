// Inverse kinematics against Orocos KDL and against the definition of the nearest pose.
#include <random>

#include "program/reach/path_check.hpp"
#include "tests/oracles/kdl.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr int kPoses = 300;

/// Pose of the flange by KDL.
Pose flange(const JointVector& q) {
  double p[3], r[3][3];
  kdl_flange(q.data(), p, r);
  Matrix3 rotation;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) rotation(i, j) = r[i][j];
  return {Vector3(p[0], p[1], p[2]), Eigen::Quaterniond(rotation)};
}

double distance(const Pose& a, const Pose& b) {
  return (a.p - b.p).norm();
}
/// What the inverse kinematics makes least: a metre counts as a radian.
double squares(const Pose& target, const JointVector& q) {
  const Pose x = flange(q);
  const double angle = target.r.angularDistance(x.r);
  return (target.p - x.p).squaredNorm() + angle * angle;
}

struct Bench {
  std::mt19937 random{7};
  JointLimits limits;
  InverseKinematics arm{limits, Pose()};

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  }
  JointVector posture(double margin) {
    JointVector q;
    for (int i = 0; i < kDof; ++i)
      q[i] = uniform(limits.q_min[i] + margin, limits.q_max[i] - margin);
    return q;
  }
  JointVector beside(const JointVector& q, double by) {
    JointVector near = q;
    for (int i = 0; i < kDof; ++i) near[i] += uniform(-by, by);
    return near.cwiseMax(limits.q_min).cwiseMin(limits.q_max);
  }
};

// Proves RUN-26.

void a_pose_near_the_arm_is_reached_within_the_limits(void**) {
  Bench bench;
  int reached = 0;
  for (int n = 0; n < kPoses; ++n) {
    const JointVector there = bench.posture(0.1);
    JointVector q = bench.beside(there, 0.1);
    const Reach reach = bench.arm.solve(flange(there), q, 200);
    assert_true((q - bench.limits.q_min).minCoeff() >= 0.0);
    assert_true((bench.limits.q_max - q).minCoeff() >= 0.0);
    ASSERT_NEAR(reach.distance_m, distance(flange(q), flange(there)), 1e-7);
    reached += reach.reached() ? 1 : 0;
  }
  print_message("%d of %d poses reached\n", reached, kPoses);
  assert_true(reached >= kPoses - 3);  // a step may lead into another branch
}

/// No posture beside it is better by more than the tolerance of the iteration.
void a_pose_out_of_reach_is_approached_as_near_as_the_joints_allow(void**) {
  Bench bench;
  for (int n = 0; n < 20; ++n) {
    JointVector q = bench.posture(0.1);
    Pose target = flange(bench.beside(q, 0.3));
    target.p += Vector3(bench.uniform(-1, 1), bench.uniform(-1, 1), 2.5);
    const Reach reach = bench.arm.solve(target, q, 3000);
    assert_false(reach.reached());
    const double least = squares(target, q);
    for (int k = 0; k < 500; ++k)
      assert_true(squares(target, bench.beside(q, 1e-3)) > least - 2e-5);
  }
}

void a_motion_of_the_posture_leaves_the_tip_where_it_is(void**) {
  Bench bench;
  for (int n = 0; n < kPoses; ++n) {
    const JointVector from = bench.posture(0.5);
    JointVector q = from;
    bench.arm.move_posture(bench.posture(0.1), 1e-4, q);
    assert_true(distance(flange(q), flange(from)) < 1e-6);
    if (kDof <= 6) assert_true(q == from);
  }
}

/// Where findings are too many to be kept, too.
void what_is_out_of_reach_is_known_after_any_number_of_findings(void**) {
  Bench bench;
  const JointVector middle = 0.5 * (bench.limits.q_min + bench.limits.q_max);
  const JointVector q = middle + 0.3 * JointVector::Ones();
  PathCheck check(bench.arm, q);
  check.approach(bench.arm.tip(q));
  double time_s = 0.0;
  for (std::size_t k = 0; k < 2 * PathCheck::kMostFindings; ++k) {  // a jump, and a rest
    const Pose pose = bench.arm.tip(bench.beside(q, 0.1));
    for (int i = 0; i < 2; ++i) check.go_on(time_s += 1e-3, pose);
  }
  assert_true(check.left_out() > 0);
  assert_false(check.out_of_reach());
  Pose far = bench.arm.tip(q);
  far.p.x() += 5.0;
  check.go_on(time_s + 1e-3, far);
  assert_true(check.out_of_reach());
}

/// A joint turns alone, much faster than it can, and then into its limit.
void a_path_that_is_too_fast_and_ends_at_a_limit_is_found(void**) {
  Bench bench;
  JointVector q = 0.5 * (bench.limits.q_min + bench.limits.q_max);
  q += 0.3 * JointVector::Ones();
  PathCheck check(bench.arm, q);
  const double speed = 3.0 * bench.limits.dq_max[0];
  check.approach(bench.arm.tip(q));
  for (int k = 0; k <= 20; ++k) {
    JointVector next = q;
    next[0] += speed * k * 1e-3;
    check.go_on(k * 1e-3, bench.arm.tip(next));
  }
  bool found = false;
  for (int i = 0; i < check.count(); ++i) found |= check[i].kind == Finding::kFastJoint;
  assert_true(found);
}

void findings_beyond_the_most_are_counted(void**) {
  Bench bench;
  const JointVector q = bench.posture(0.5);
  PathCheck check(bench.arm, q);
  const Pose near = bench.arm.tip(q), far = {near.p + Vector3(0.0, 0.0, 5.0), near.r};
  for (int k = 0; k < 400; ++k) check.go_on(k, k % 2 == 0 ? near : far);
  assert_int_equal(check.count(), PathCheck::kMostFindings);
  assert_true(check.left_out() > 100 && check.left_out() < 1500);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_pose_near_the_arm_is_reached_within_the_limits),
      cmocka_unit_test(a_pose_out_of_reach_is_approached_as_near_as_the_joints_allow),
      cmocka_unit_test(a_motion_of_the_posture_leaves_the_tip_where_it_is),
      cmocka_unit_test(what_is_out_of_reach_is_known_after_any_number_of_findings),
      cmocka_unit_test(a_path_that_is_too_fast_and_ends_at_a_limit_is_found),
      cmocka_unit_test(findings_beyond_the_most_are_counted),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
