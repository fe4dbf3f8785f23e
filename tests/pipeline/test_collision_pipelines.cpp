// Tests every shipped pipeline with its trajectory in the plant, checked for collisions as its
// section requests or by default: no collision is reported.
#include <cstring>

#include "kernel/guard/collision.hpp"
#include "tests/pipeline/pipeline_bench.hpp"

namespace tactus {
namespace {

struct Run {
  std::string pipeline;
  double end_s;
  std::string trajectory = "";
};

/// Runs only on the robot of the pipeline.
void assert_free(const Run& run) {
  if (!is_of_this_robot(run.pipeline)) return;
  static std::array<PipelineBench, 7> benches;
  static std::size_t used = 0;
  PipelineBench& bench = benches.at(used++);
  bench.start(run.pipeline, "", "", run.trajectory);
  const Pipeline& pipeline = bench.pipeline;
  CollisionSection section = pipeline.collision;
  // A file without the section has no lateness: only whether its arm, as it moves, stays clear.
  const JointVector* reference = pipeline.reference();
  if (bench.text.find("\n[collision]") == std::string::npos) {
    section.cycles = pipeline.robot.period_us > 4000 ? 1 : 5;
    section.lateness.setZero();
    section.overshoot.setZero();
    section.compliance.setZero();
    reference = nullptr;
  }
  Collision collision;
  collision.start(section, pipeline.guard.effective(), pipeline.robot.tool.value.tip.p,
                  pipeline.robot.period_s(), reference);
  while (bench.time_s() < run.end_s) {
    bench.cycle();
    RobotState state;
    state.q = bench.output<JointVector>("robot.q");
    state.dq = bench.output<JointVector>("robot.dq");
    const Status status = collision.step(state);
    const Collision::Telemetry& told = collision.telemetry();
    if (status != Status::kOk)
      print_error("%s at %.3f s: %s, %s with %s, %s\n", run.pipeline.c_str(), bench.time_s(),
                  name(status), told.first, told.second, told.predicted ? "predicted" : "now");
    ASSERT_OK(status);
  }
  assert_true(collision.telemetry().checks > 100);
}

// Proves COL-8.

void free_motion_is_free(void**) {
  assert_free({of_this_robot("_jrg_pdgc"), 12.0, five_waypoints()});
  assert_free({"fer_trg_cpc", 15.0});
  assert_free({"ur10_jrg_pid", 12.0});
  assert_free({"ur10_trg_cpc", 15.0});
  assert_free({"ur10_trg_cpc_125", 15.0});
}

/// This trajectory is too long for the bench; the test supplies waypoints of its own, one every
/// millisecond.
void the_excitation_is_free(void**) {
  need_one_of({"fer_excitation"});
  std::FILE* file = std::fopen("build/trajectories/fer_excitation.csv", "r");
  assert_non_null(file);
  Collision collision;
  CollisionSection section;
  section.lateness.setZero();
  section.overshoot.setZero();
  section.compliance.setZero();
  collision.start(section, JointLimits(), Vector3::Zero(), 0.001);
  // Comments, then the header: time_s, q1_rad ... q7_rad, dq1_rad_s ...
  char line[512] = "";
  while (std::strncmp(line, "time_s", 6) != 0) assert_non_null(std::fgets(line, sizeof line, file));
  RobotState state;
  int row = 0;
  for (double time_s = 0.0; std::fscanf(file, "%lf", &time_s) == 1; ++row) {
    for (double& q : state.q) assert_int_equal(std::fscanf(file, ",%lf", &q), 1);
    for (double& dq : state.dq) assert_int_equal(std::fscanf(file, ",%lf", &dq), 1);
    assert_int_equal(std::fscanf(file, "%*[^\n]"), 0);
    ASSERT_OK(collision.step(state));
  }
  std::fclose(file);
  assert_true(row > 10000);
}

void only_the_tool_touches(void**) {
  need_one_of({"fer_trg_ac_cpc_pid", "ur10_trg_ac_cpc", "ur10_trg_ac_cpc_pid"});
  assert_free({"fer_trg_ac_cpc_pid", 16.0});
  assert_free({"ur10_trg_ac_cpc", 18.0});
  assert_free({"ur10_trg_ac_cpc_pid", 15.0});
}

/// Repeats a run with a tool that must not touch: the arm is at rest before contact.
void a_touch_that_is_not_allowed_stops_the_arm_before_it(void**) {
  need_one_of({"fer_trg_ac_cpc_pid"});
  static PipelineBench bench;
  bench.start("fer_trg_ac_cpc_pid", "allow ", "# ");
  const Executive& executive = bench.executive;
  Status status = Status::kOk;
  while (bench.time_s() < 12.0 && executive.rung() != Rung::kDisabled) {
    status = bench.executive.cycle(bench.next());
    assert_true(bench.contact().norm() == 0.0);
  }
  ASSERT_STATUS(status, Status::kCollision);
  assert_int_equal(executive.rung(), Rung::kDisabled);
  assert_true(bench.output<JointVector>("robot.dq").norm() < 0.05);
  const Collision::Telemetry& told = bench.pipeline.collision_check.telemetry();
  assert_string_equal(told.first, "table");
  assert_string_equal(told.second, "tool");
  assert_true(told.predicted);
}

// Proves COL-10.

/// The UR10 starts within the margin of its blackboard.
void an_arm_that_touches_is_not_armed(void**) {
  need_one_of({"ur10_trg_ac_cpc"});
  static PipelineBench bench;
  ASSERT_STATUS(bench.refused("ur10_trg_ac_cpc", "allow ", "# "), Status::kCollision);
  assert_int_equal(bench.executive.rung(), Rung::kDisabled);
  ASSERT_STATUS(bench.executive.latched(), Status::kCollision);
  const Collision::Telemetry& told = bench.pipeline.collision_check.telemetry();
  assert_string_equal(told.first, "blackboard");
  assert_string_equal(told.second, "tool");
  assert_false(told.predicted);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(free_motion_is_free),
      cmocka_unit_test(the_excitation_is_free),
      cmocka_unit_test(only_the_tool_touches),
      cmocka_unit_test(a_touch_that_is_not_allowed_stops_the_arm_before_it),
      cmocka_unit_test(an_arm_that_touches_is_not_armed),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
