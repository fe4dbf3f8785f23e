// A collision that is predicted does not happen, with a redundant arm whose elbow moves while its
// tip stands: every joint brakes at once, and the arm rests outside the margin.
#include <optional>

#include "tests/collision_bench.hpp"
#include "tests/pipeline_bench.hpp"
#include "tests/testing.hpp"

namespace tactus {
namespace {

// A post beside the elbow, and a posture that swings the elbow into it while the tip stays.
constexpr const char* kBlocks =
    "[post]\ntype = box\ncentre = -0.12 %g 0.6\nsize = 0.3 0.1 0.6\n"
    "[collision]\ndivisor = %d\nmargin = 0.01\n"
    "[jrg]\ntype = joint_reference_generator\nq = robot.q\n"
    "[cpc]\nq_posture = jrg.q_d\nposture_gain = 5\n";

struct Swing {
  std::optional<PipelineBench> bench;
  CollisionBench oracle;  // by KDL and FCL
  double nearest = 1.0, last = 1.0;

  Swing(double post_y, int divisor) {
    char blocks[512];
    std::snprintf(blocks, sizeof blocks, kBlocks, post_y, divisor);
    bench.emplace().start("fer_trg_cpc", "[cpc]\n", blocks);
    oracle.tip = Vector3::Zero();
    oracle.boxes[0] = {{{-0.12, post_y, 0.6}, Eigen::Quaterniond::Identity()}, {0.3, 0.1, 0.6}};
    oracle.boxes[1] = {{{9.0, 9.0, 9.0}, Eigen::Quaterniond::Identity()}, {0.1, 0.1, 0.1}};
  }
  /// The joints go towards a posture whose elbow is beside the arm.
  void swing(double side) {
    Trajectory<JointSpace>& motion = *bench->client.acquire();
    motion.count = 1;
    motion.fields = kVelocityField | kAccelerationField;
    motion.waypoints[0] = {};
    motion.waypoints[0].time_s = 1.5;
    motion.waypoints[0].point.q = bench->output<JointVector>("jrg.q_d");
    motion.waypoints[0].point.q[0] += side, motion.waypoints[0].point.q[2] -= side;
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

// Proves COL-9.

void the_elbow_stops_before_the_post(void**) {
  for (const double side : {1.0, -1.0})
    for (const int divisor : {1, 8}) {
      static std::optional<Swing> swing_;
      Swing& swing = swing_.emplace(side * -0.22, divisor);
      swing.swing(side * 1.6);
      Status status = Status::kOk;
      while (status == Status::kOk && swing.bench->time_s() < 4.0) status = swing.cycle();
      ASSERT_STATUS(status, Status::kCollision);
      const Collision::Telemetry& told = swing.bench->pipeline.collision_check.telemetry();
      const double found_m = swing.last;
      const double speed = swing.bench->output<JointVector>("robot.dq").norm();
      assert_true(told.predicted && speed > 0.1);
      while (swing.bench->executive.braking()) static_cast<void>(swing.cycle());
      for (int k = 0; k < 100; ++k) static_cast<void>(swing.cycle());
      print_message("%s, found at %.1f mm and %.2f rad/s, rests at %.1f mm, nearest %.1f mm\n",
                    told.second, 1e3 * found_m, speed, 1e3 * swing.last, 1e3 * swing.nearest);
      assert_true(swing.nearest > 0.01);
      assert_true(swing.last < 0.08);  // and the check looks no further than it must
      assert_int_equal(swing.bench->executive.rung(), Rung::kDisabled);
    }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_elbow_stops_before_the_post),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
