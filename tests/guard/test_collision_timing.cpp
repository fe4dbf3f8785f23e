// Tests the latest moment of the collision check: where it just lets the arm go, the arm stays
// outside the margin but comes near it, by the oracles KDL and FCL.
#include "tests/guard/collision_bench.hpp"
#include "tests/support/model_cases.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

/// A bench for one motion.
CollisionBench& fresh() {
  static std::array<CollisionBench, 4> benches;
  static std::size_t used = 0;
  return benches.at(used++);
}

// Proves COL-3.

/// One joint alone turns the tip towards a small cube, placed where the check just lets it go.
/// Returns the distance between them, m, when the arm is farthest: accelerated for `reaction_s`,
/// then braked.
double left_just_in_time(CollisionBench& bench, JointVector q, int joint, double reaction_s) {
  for (int i = 0; i < kDof; ++i)
    if (i != joint) bench.limits.ddq_max[i] = 0.01;  // so that all depends on one joint
  bench.limits.dddq_max.setConstant(1e9);
  JointVector dq = JointVector::Zero();
  const double v = dq[joint] = 0.9 * bench.limits.dq_max[joint], a = bench.limits.ddq_max[joint];
  const double faster = v + a * reaction_s, braking = bench.section.limits.ddq_max[joint];
  bench.boxes[1].pose.p.z() = -5.0;
  bench.boxes[0].size = Vector3::Constant(0.05);
  double p[3], r[3][3];
  kdl_link(q.data(), joint + 1, p, r);
  const Vector3 centre(p[0], p[1], p[2]), axis(r[0][2], r[1][2], r[2][2]);
  const Vector3 tip = tip_pose(q, Pose{bench.tip, {1.0, 0.0, 0.0, 0.0}}).p - centre;
  bench.start();
  double hit = 0.0, free = 1.5;  // angles of the cube ahead of the tip
  for (int k = 0; k < 30; ++k) {
    const double angle = 0.5 * (hit + free);
    bench.boxes[0].pose.p = centre + Eigen::AngleAxisd(angle, axis) * tip;
    (bench.check(q, dq) == Status::kOk ? free : hit) = angle;
  }
  assert_true(hit > 0.0 && free < 1.5);
  bench.boxes[0].pose.p = centre + Eigen::AngleAxisd(free, axis) * tip;
  ASSERT_OK(bench.check(q, dq));
  q[joint] +=
      v * reaction_s + 0.5 * a * reaction_s * reaction_s + faster * faster / (2.0 * braking);
  const double left = bench.nearest(q).distance;
  print_message("joint %d: %.1f mm left\n", joint + 1, 1e3 * left);
  return left;
}

/// The arm stretched out, with the tip far from the axis of the last joint too.
JointVector stretched_out(CollisionBench& bench) {
  const JointVector q(published().stretched);
  bench.tip = {0.25, 0.0, 0.05};
  return q;
}

/// Where the check just lets it go, the arm ends outside the margin, and near it: for the first
/// joint, which turns the whole arm, and for the last, which turns the tool alone.
void just_in_time_is_in_time(void**) {
  for (const int joint : {0, kDof - 1}) {
    CollisionBench& bench = fresh();
    const JointVector q = stretched_out(bench);
    const double left = left_just_in_time(bench, q, joint, 5 * CollisionBench::kPeriod_s);
    assert_true(left > bench.section.margin && left < bench.section.margin + 0.05);
  }
}

/// A robot that stops at once on command, one cycle after the next check.
void until_the_brake_begins_one_cycle_more_than_the_next_check_counts(void**) {
  for (const int divisor : {1, 3}) {
    CollisionBench& bench = fresh();
    const JointVector q = stretched_out(bench);
    bench.limits.ddq_max[0] = 0.01;
    bench.section.limits.ddq_max.setConstant(1e4);
    bench.section.divisor = divisor;
    const double reaction_s = (divisor + 1) * CollisionBench::kPeriod_s;
    const double left = left_just_in_time(bench, q, 0, reaction_s);
    assert_true(left > bench.section.margin && left < bench.section.margin + 0.003);
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(just_in_time_is_in_time),
      cmocka_unit_test(until_the_brake_begins_one_cycle_more_than_the_next_check_counts),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
