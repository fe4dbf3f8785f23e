// Tests the latest moment of the collision check: where it just lets the arm go, the arm stays
// outside the margin but comes near it, by the oracles KDL and FCL.
#include "tests/guard/collision_bench.hpp"
#include "tests/support/middle_of_range.hpp"
#include "tests/support/model_cases.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

/// A bench for one motion.
CollisionBench& fresh() {
  static std::array<CollisionBench, 8> benches;
  static std::size_t used = 0;
  return benches.at(used++);
}

/// One joint alone turns the tip towards a small cube, placed where the check just lets it go.
struct Turn {
  CollisionBench& bench;
  JointVector q;
  int joint;
  JointVector dq = JointVector::Zero();

  double acceleration() const { return bench.limits.ddq_max[joint]; }
  double way(double t_s) const { return dq[joint] * t_s + 0.5 * acceleration() * t_s * t_s; }

  /// Places the cube.
  void place() {
    for (int i = 0; i < kDof; ++i)
      if (i != joint) bench.limits.ddq_max[i] = 0.01;  // so that all depends on one joint
    bench.limits.dddq_max.setConstant(1e9);
    dq[joint] = 0.9 * bench.limits.dq_max[joint];
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
  }
  /// Returns the distance left, m, when the arm is farthest: accelerated for `reaction_s`, then
  /// braked.
  double left(double reaction_s) const {
    const double faster = dq[joint] + acceleration() * reaction_s;
    JointVector end = q;
    end[joint] += way(reaction_s) + faster * faster / (2.0 * bench.section.braking[joint]);
    return bench.nearest(end).distance;
  }
};

/// The arm stretched out, with the tip far from the axis of the last joint too.
JointVector stretched_out(CollisionBench& bench) {
  bench.tip = {0.25, 0.0, 0.05};
  return JointVector(published().stretched);
}

// Proves COL-3.

/// Where the check just lets it go, the arm ends outside the margin, and near it: for the first
/// joint, which turns the whole arm, and for the last, which turns the tool alone.
void just_in_time_is_in_time(void**) {
  for (const int joint : {kFirstRevolute, kDof - 1}) {
    CollisionBench& bench = fresh();
    Turn turn{bench, stretched_out(bench), joint};
    turn.place();
    const double left = turn.left(2 * bench.section.cycles * CollisionBench::kPeriod_s);
    print_message("joint %d: %.1f mm left\n", joint + 1, 1e3 * left);
    assert_true(left > bench.section.margin && left < bench.section.margin + 0.05);
  }
}

/// A joint that stops at once on command. Braked one cycle later it would be in the margin.
void until_the_brake_begins_the_cycles_of_two_checks_count_and_no_more(void**) {
  for (const int cycles : {1, 2, 5}) {
    CollisionBench& bench = fresh();
    Turn turn{bench, stretched_out(bench), kDof - 1};
    bench.tip = {0.6, 0.0, 0.05};
    bench.limits.ddq_max[kDof - 1] = 0.01;
    bench.section.braking.setConstant(1e4);
    bench.section.cycles = cycles;
    turn.place();
    const double margin = bench.section.margin;
    const double in_time = turn.left(2 * cycles * CollisionBench::kPeriod_s);
    const double late = turn.left((2 * cycles + 1) * CollisionBench::kPeriod_s);
    print_message("%d cycles: %.2f mm left, %.2f mm if late\n", cycles, 1e3 * in_time, 1e3 * late);
    assert_true(in_time > margin && late < margin);
  }
}

/// The first check just lets the arm go. It goes on with its acceleration until the second check
/// reports it: in the last cycle before the brake, because the contact is in the last section.
void a_contact_is_reported_within_the_cycles_of_two_checks(void**) {
  for (const int cycles : {1, 2, 5}) {
    CollisionBench& bench = fresh();
    Turn turn{bench, stretched_out(bench), kFirstRevolute};
    bench.section.cycles = cycles;
    turn.place();
    bench.start();
    Status status = Status::kOk;
    int cycle = -1;
    while (status == Status::kOk && cycle < 100) {
      const double t_s = ++cycle * CollisionBench::kPeriod_s;
      JointVector q = turn.q, dq = turn.dq;
      q[kFirstRevolute] += turn.way(t_s);
      dq[kFirstRevolute] += turn.acceleration() * t_s;
      status = bench.step(q, dq);
    }
    ASSERT_STATUS(status, Status::kCollision);
    assert_int_equal(cycle, 2 * cycles - 1);
    assert_true(turn.left((cycle + 1) * CollisionBench::kPeriod_s) > bench.section.margin);
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(just_in_time_is_in_time),
      cmocka_unit_test(until_the_brake_begins_the_cycles_of_two_checks_count_and_no_more),
      cmocka_unit_test(a_contact_is_reported_within_the_cycles_of_two_checks),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
