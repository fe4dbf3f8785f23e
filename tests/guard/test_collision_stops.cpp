// Tests that a predicted collision does not happen: a redundant arm's elbow moves while its tip
// stays, every joint brakes at once, and the arm rests outside the margin. Distances are those of
// KDL and FCL.
#include <optional>

#include "tests/guard/collision_bench.hpp"
#include "tests/pipeline/pipeline_bench.hpp"
#include "tests/support/testing.hpp"
#include "tests/support/trials.hpp"

namespace tactus {
namespace {

// A post near the elbow, and a posture that swings the elbow into it while the tip stays.
constexpr const char* kBlocks =
    "[post]\ntype = box\ncentre = -0.12 %g 0.6\nsize = 0.3 0.1 0.6\n"
    "[collision]\ncycles = %d\nmargin = 0.01\n"
    "[jrg]\ntype = joint_reference_generator\nq = robot.q\n"
    "[cpc]\nq_posture = jrg.q_d\nposture_gain = 5\n";

struct Swing {
  std::optional<PipelineBench> bench;
  CollisionBench oracle;  // by KDL and FCL
  double nearest = 1.0, last = 1.0;

  Swing(double post_y, int cycles) {
    char blocks[512];
    std::snprintf(blocks, sizeof blocks, kBlocks, post_y, cycles);
    bench.emplace().start("fer_trg_cpc", "[cpc]\n", blocks);
    oracle.tip = Vector3::Zero();
    oracle.boxes[0] = {{{-0.12, post_y, 0.6}, Eigen::Quaterniond::Identity()}, {0.3, 0.1, 0.6}};
    oracle.boxes[1] = {{{9.0, 9.0, 9.0}, Eigen::Quaterniond::Identity()}, {0.1, 0.1, 0.1}};
  }
  /// Moves the joints towards a posture whose elbow is at the side of the arm.
  void swing(double side) {
    Trajectory<JointSpace>& motion = *bench->client.acquire();
    motion.count = 1;
    motion.fields = kVelocityField | kAccelerationField;
    motion.waypoints[0] = {};
    motion.waypoints[0].time_s = 1.5;
    motion.waypoints[0].point.q = bench->output<JointVector>("jrg.q_d");
    motion.waypoints[0].point.q[0] += side;
    motion.waypoints[0].point.q[2] -= side;
    std::uint32_t id = 0;
    ASSERT_OK(bench->client.send(motion, id).status);
  }
  Status cycle() {
    const Status status = bench->executive.cycle(bench->next());
    const JointVector q = bench->hal.arm().q();
    last = 1.0;
    for (int link = 3; link <= kToolBody; ++link)
      last = std::min(last, oracle.between(q, kFirstBoxBody, link));
    nearest = std::min(nearest, last);
    return status;
  }
};

/// A table under the hand, and joint positions as references: straight lines, whose first step in
/// velocity the guard can follow only with a lag.
constexpr const char* kTable =
    "q_c = jrg.q_d\n[table]\ntype = box\ncentre = 0.75 0 %g\nsize = 0.8 0.8 0.1\n"
    "[collision]\ncycles = %d\nmargin = 0.01\n"
    "[jrg]\ntype = joint_reference_generator\nq = robot.q\n";

/// Joint 2 lowers the arm onto the table. Returns the smallest distance, m, or 1 if it is not
/// stopped.
double nearest_to_table(double top, int cycles) {
  static std::optional<PipelineBench> bench_;
  PipelineBench& bench = bench_.emplace();
  char blocks[512];
  std::snprintf(blocks, sizeof blocks, kTable, top - 0.05, cycles);
  bench.start("fer_trg_cpc", "q_c       = cpc.q_c\n", blocks);
  CollisionBench oracle;
  oracle.tip = Vector3::Zero();
  oracle.boxes[0] = {{{0.75, 0.0, top - 0.05}, Eigen::Quaterniond::Identity()}, {0.8, 0.8, 0.1}};
  oracle.boxes[1] = {{{9.0, 9.0, 9.0}, Eigen::Quaterniond::Identity()}, {0.1, 0.1, 0.1}};
  Trajectory<JointSpace>& motion = *bench.client.acquire();
  motion.count = 2;
  motion.fields = 0;
  for (int i = 0; i < 2; ++i) {
    motion.waypoints[i] = {};
    motion.waypoints[i].time_s = i;
    motion.waypoints[i].point.q = bench.output<JointVector>("jrg.q_d");
  }
  motion.waypoints[1].point.q[1] += 0.54;
  std::uint32_t id = 0;
  ASSERT_OK(bench.client.send(motion, id).status);
  double nearest = 1.0;
  while (bench.executive.rung() != Rung::kDisabled && bench.time_s() < 2.0) {
    static_cast<void>(bench.executive.cycle(bench.next()));
    nearest = std::min(nearest, oracle.nearest(bench.hal.arm().q()).distance);
  }
  return bench.executive.rung() == Rung::kDisabled ? nearest : 1.0;
}

// Proves COL-9.

void an_arm_that_lags_behind_its_reference_does_not_catch_up_into_a_table(void**) {
  constexpr int kHeights = tries(30, 6);
  int stopped = 0;
  double nearest = 1.0;
  for (int i = 0; i < kHeights; ++i) {
    const int mm = 60 / kHeights * i;
    const double distance = nearest_to_table(0.40 + 1e-3 * mm, 1);
    stopped += distance < 1.0 ? 1 : 0;
    nearest = std::min(nearest, distance);
  }
  print_message("%d of %d stopped, nearest %.1f mm\n", stopped, kHeights, 1e3 * nearest);
  assert_true(stopped > kHeights / 3);
  assert_true(nearest > 0.01);
}

void the_elbow_stops_before_the_post(void**) {
  for (const double side : {1.0, -1.0})
    for (const int cycles : {1, 5}) {
      static std::optional<Swing> swing_;
      Swing& swing = swing_.emplace(side * -0.22, cycles);
      swing.swing(side * 1.6);
      Status status = Status::kOk;
      while (status == Status::kOk && swing.bench->time_s() < 4.0) status = swing.cycle();
      ASSERT_STATUS(status, Status::kCollision);
      const Collision::Telemetry& told = swing.bench->pipeline.collision_check.telemetry();
      const double found_m = swing.last;
      const double speed = swing.bench->output<JointVector>("robot.dq").norm();
      assert_true(told.predicted && speed > 0.1);
      while (swing.bench->executive.busy()) static_cast<void>(swing.cycle());
      for (int k = 0; k < 100; ++k) static_cast<void>(swing.cycle());
      print_message("%s, found at %.1f mm and %.2f rad/s, rests at %.1f mm, nearest %.1f mm\n",
                    told.second, 1e3 * found_m, speed, 1e3 * swing.last, 1e3 * swing.nearest);
      assert_true(swing.nearest > 0.01);
      assert_true(swing.last < 0.08);  // the check does not look farther than necessary
      assert_int_equal(swing.bench->executive.rung(), Rung::kDisabled);
    }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_elbow_stops_before_the_post),
      cmocka_unit_test(an_arm_that_lags_behind_its_reference_does_not_catch_up_into_a_table),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
