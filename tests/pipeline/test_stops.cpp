// Tests a stop in the middle of every shipped pipeline: the arm comes to rest, and the event log
// names the cause.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>

#include "tests/pipeline/pipeline_bench.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

struct Run {
  std::string pipeline;
  double moving_s;  ///< when every joint moves
  std::string trajectory = "";
};

const Run kRuns[] = {
    {of_this_robot("_jrg_pdgc"), 3.0, five_waypoints()},
    {"fer_trg_cpc", 2.0},
    {"fer_trg_ac_cpc_pid", 3.0},
    {"fer_trg_ac_cpc_pid", 9.5},
    {"ur10_jrg_pid", 2.0},
    {"ur10_trg_cpc", 6.0},
    {"ur10_trg_cpc_125", 6.0},
    {"ur10_trg_ac_cpc", 14.0},
    {"ur10_trg_ac_cpc_pid", 3.0},
};

enum class Stop { kHalt, kCollision, kSlip, kLongSlip };

bool g_collides = false;

Status find_collision(void*, const RobotState&, double) {
  return g_collides ? Status::kCollision : Status::kOk;
}

bool in_log(const EventLog& events, Cause cause) {
  Event event;
  for (std::uint32_t i = 0; i < events.count(); ++i)
    if (events.read(i, event) && event.cause == cause) return true;
  return false;
}

/// Triggers a step down the ladder in the present cycle.
void stop(PipelineBench& bench, Stop why) {
  const int bridged = bench.pipeline.executive.max_slip;
  if (why == Stop::kHalt) bench.executive.halt();
  if (why == Stop::kCollision) g_collides = true;
  if (why == Stop::kSlip) bench.cycles += bridged + 1;
  if (why == Stop::kLongSlip) bench.cycles += 2 * bridged + 1;
}

void assert_ends_at_rest(const Run& run, Stop why, Rung end) {
  if (!is_of_this_robot(run.pipeline)) return;
  static std::optional<PipelineBench> bench_;
  PipelineBench& bench = bench_.emplace();
  g_collides = false;
  bench.start(run.pipeline, "", "", run.trajectory);
  ASSERT_OK(bench.executive.add({"collision_test", 1, 0, 10, false, find_collision, nullptr}));
  while (bench.time_s() < run.moving_s) bench.cycle();
  const double speed = bench.output<JointVector>("robot.dq").norm();
  if (!(speed > 0.01)) print_error("%s does not move: %g rad/s\n", run.pipeline.c_str(), speed);
  assert_true(speed > 0.01);
  stop(bench, why);
  const Executive& executive = bench.executive;
  static_cast<void>(bench.executive.cycle(bench.next()));
  const double begin_s = bench.time_s();
  while (executive.busy() && bench.time_s() < begin_s + 10.0)
    static_cast<void>(bench.executive.cycle(bench.next()));
  const bool at_rest = in_log(executive.events(), Cause::kAtRest);
  if (!at_rest || executive.rung() != end || in_log(executive.events(), Cause::kStopTime))
    print_error("%s: %s, %s after %.3f s\n", run.pipeline.c_str(), name(executive.latched()),
                name(executive.rung()), bench.time_s() - begin_s);
  assert_true(at_rest && !in_log(executive.events(), Cause::kStopTime));
  assert_int_equal(executive.rung(), end);
  if (end == Rung::kDisabled) return;
  const JointVector q = bench.output<JointVector>("robot.q");
  for (int k = 0; k < 200; ++k) static_cast<void>(bench.executive.cycle(bench.next()));
  assert_true((bench.output<JointVector>("robot.q") - q).cwiseAbs().maxCoeff() < 2e-3);
}

// Proves LAD-12.

void a_halt_ends_at_rest(void**) {
  for (const Run& run : kRuns) assert_ends_at_rest(run, Stop::kHalt, Rung::kDisabled);
}

void a_collision_ends_at_rest(void**) {
  for (const Run& run : kRuns) assert_ends_at_rest(run, Stop::kCollision, Rung::kDisabled);
}

void a_slip_ends_at_rest_and_is_held(void**) {
  for (const Run& run : kRuns) assert_ends_at_rest(run, Stop::kSlip, Rung::kHold);
}

void a_long_slip_ends_at_rest(void**) {
  for (const Run& run : kRuns) assert_ends_at_rest(run, Stop::kLongSlip, Rung::kDisabled);
}

// Proves LAD-17.

/// Has the last joint leave `q` by 2 rad within 5 s.
void turn_last_joint(PipelineBench& bench, const JointVector& q) {
  Trajectory<JointSpace>* turn = bench.client.acquire();
  assert_non_null(turn);
  turn->count = 2;
  turn->fields = kVelocityField;
  for (int i = 0; i < 2; ++i) {
    Waypoint<JointSpace>& waypoint = turn->waypoints[i];
    waypoint = {};
    waypoint.time_s = 5.0 * i;
    waypoint.point.q = q;
    waypoint.point.q[kDof - 1] += 2.0 * i;
  }
  std::uint32_t id = 0;
  assert_true(bench.client.send(*turn, id).ok());
}

/// Wrist 3 has a tenth to a quarter of its critical damping, so that it swings on after its
/// reference has stopped.
void a_lightly_damped_loop_that_is_stopped_in_motion_is_held(void**) {
  need_one_of({"ur10_jrg_pid"});
  static std::optional<PipelineBench> bench_;
  for (const char* kd : {"10 5 0.4", "10 5 0.5", "10 5 0.6", "10 5 0.8"}) {
    PipelineBench& bench = bench_.emplace();
    const Executive& executive = bench.executive;
    bench.start("ur10_jrg_pid", "10 5 2", kd, five_waypoints());
    turn_last_joint(bench, bench.output<JointVector>("robot.q"));
    while (bench.time_s() < 2.0) bench.cycle();
    assert_true(bench.output<JointVector>("robot.dq")[kDof - 1] > 0.4);
    stop(bench, Stop::kSlip);
    double fastest = 0.0;  // rad/s, once the reference is at rest
    int held = 0;          // cycles
    while (held < 2000) {
      static_cast<void>(bench.executive.cycle(bench.next()));
      assert_true(executive.rung() == Rung::kHold);
      held += executive.busy() ? 0 : 1;
      if (bench.output<JointVector>("jrg.dq_d").isZero(0.0))
        fastest = std::max(fastest, std::abs(bench.output<JointVector>("robot.dq")[kDof - 1]));
    }
    if (fastest < 0.2) print_error("kd %s: %g rad/s\n", kd, fastest);
    assert_true(fastest > 0.2);
    ASSERT_STATUS(executive.latched(), Status::kSlip);
  }
}

// Proves LAD-13.

/// The arm brakes on its path first, and at once if a collision is detected meanwhile. The log and
/// the joints show both.
void a_brake_on_the_path_becomes_one_at_once_and_is_told(void**) {
  const Run* run = std::find_if(std::begin(kRuns), std::end(kRuns), [](const Run& each) {
    return each.pipeline == of_this_robot("_trg_cpc");
  });
  if (run == std::end(kRuns)) _skip(__FILE__, __LINE__);  // the robot has no such pipeline
  static PipelineBench bench;
  g_collides = false;
  bench.start(run->pipeline);
  Executive& executive = bench.executive;
  ASSERT_OK(executive.add({"collision_test", 1, 0, 10, false, find_collision, nullptr}));
  while (bench.time_s() < run->moving_s) bench.cycle();
  executive.halt();
  static_cast<void>(executive.cycle(bench.next()));
  g_collides = true;
  for (int k = 0; k < 3; ++k) static_cast<void>(executive.cycle(bench.next()));
  Event event;
  assert_true(executive.events().read(executive.events().count() - 2, event));
  assert_true(event.cause == Cause::kHalt && event.to == Rung::kStop);
  assert_true(executive.events().read(executive.events().count() - 1, event));
  assert_true(event.cause == Cause::kRow && event.from == Rung::kStop && event.to == Rung::kStop);
  ASSERT_STATUS(event.status, Status::kCollision);
  JointVector dq = bench.output<JointVector>("cpc.dq_c");
  const JointVector most = JointLimits().ddq_max * bench.pipeline.robot.period_s();
  for (int k = 0; k < 300 && executive.busy(); ++k) {
    static_cast<void>(executive.cycle(bench.next()));
    const JointVector& now = bench.output<JointVector>("cpc.dq_c");
    for (int i = 0; i < kDof; ++i)
      ASSERT_NEAR(std::abs(now[i]), std::max(0.0, std::abs(dq[i]) - most[i]), 1e-12);
    dq = now;
  }
  assert_true(executive.rung() == Rung::kDisabled && dq.isZero(0.0));
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_halt_ends_at_rest),
      cmocka_unit_test(a_collision_ends_at_rest),
      cmocka_unit_test(a_slip_ends_at_rest_and_is_held),
      cmocka_unit_test(a_long_slip_ends_at_rest),
      cmocka_unit_test(a_lightly_damped_loop_that_is_stopped_in_motion_is_held),
      cmocka_unit_test(a_brake_on_the_path_becomes_one_at_once_and_is_told),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
