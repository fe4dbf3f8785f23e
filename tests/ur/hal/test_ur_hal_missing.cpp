// Tests packets of a UR in motion that are late, missing, repeated or skipped, and wrong time
// stamps.
#include "tests/ur/hal/ur_moving_bench.hpp"

namespace tactus::ur {
namespace {

// Proves URH-10.
void up_to_five_packets_may_be_missing(void**) {
  UrHalBench& bench = moving();
  for (int missing = 1; missing <= 5; ++missing) {
    const std::int32_t before = bench.hal.set_points();
    for (int i = 0; i < missing; ++i) ASSERT_OK(bench.run_cycle());
    bench.robot.set_point(before + missing);  // the robot takes set-points meanwhile
    ASSERT_OK(bench.cycle(missing + 1));
    ASSERT_OK(bench.cycles(10));
  }
  assert_int_equal(bench.executive.telemetry().slips, 0);
}

void from_the_sixth_on_the_wire_is_lost(void**) {
  for (const int missing : {6, 50}) {
    UrHalBench& bench = moving();
    int stopped_at = 0;
    for (int i = 1; i <= missing && stopped_at == 0; ++i)
      if (bench.run_cycle() != Status::kOk) stopped_at = i;
    assert_int_equal(stopped_at, 6);
    assert_disabled_by_wire(bench, Status::kBusTimeout);
    assert_true(bench.says("no new packet for 6 periods, limit 5"));
    bench.robot.set_point(kServoEnded);  // the program was told
    assert_reconnects_without_motion(bench);
  }
}

/// The host paused: the packets are there, but their cycles were missed.
void packets_left_out_walk_the_ladder_as_slips(void**) {
  struct Row {
    int left_out;
    Status expected;
    Rung rung;
  };
  for (const Row& row : {Row{3, Status::kOk, Rung::kNominal}, Row{4, Status::kSlip, Rung::kHold},
                         Row{7, Status::kSlip, Rung::kStop}, Row{50, Status::kSlip, Rung::kStop}}) {
    UrHalBench& bench = moving();
    for (int i = 0; i < row.left_out; ++i) bench.robot.send_package();
    ASSERT_STATUS(bench.cycle(), row.expected);
    assert_int_equal(static_cast<int>(bench.executive.rung()), static_cast<int>(row.rung));
  }
}

// Proves URH-31.

/// The time of the cycles goes on; the state keeps the stamp of its packet.
void a_state_is_as_old_as_its_packet(void**) {
  UrHalBench& bench = moving();
  constexpr std::int64_t kPeriod_ns = 8'000'000;
  CycleTime now;
  RobotState state;
  ASSERT_OK(bench.hal.read(now, state));
  const std::int64_t packet_ns = state.stamp_ns;
  ASSERT_NEAR(static_cast<double>(packet_ns) * 1e-9, bench.hal.state().timestamp_s, 1e-9);
  for (int missing = 1; missing <= 3; ++missing) {
    ASSERT_OK(bench.hal.wait(now));
    ASSERT_OK(bench.hal.read(now, state));
    assert_int_equal(now.stamp_ns - packet_ns, missing * kPeriod_ns);
    assert_int_equal(state.stamp_ns, packet_ns);
    for (const Drive& drive : state.drives) assert_true(drive.valid);
  }
  bench.robot.send_package();  // the first of the three
  ASSERT_OK(bench.hal.wait(now));
  ASSERT_OK(bench.hal.read(now, state));
  assert_int_equal(now.stamp_ns - packet_ns, 4 * kPeriod_ns);
  assert_int_equal(state.stamp_ns - packet_ns, kPeriod_ns);
}

/// A wire that bridges more than the guard: the state is too old before the wire is lost.
void a_state_that_is_too_old_stops_the_arm(void**) {
  UrHalBench& bench = g_bench.emplace();
  bench.settings.max_missed = 20;
  ASSERT_OK(bench.start());
  ASSERT_OK(bench.cycles(5));
  for (int i = 0; i < bench.pipeline.guard.max_age; ++i) ASSERT_OK(bench.run_cycle());
  ASSERT_STATUS(bench.run_cycle(), Status::kStateStale);
  assert_int_equal(static_cast<int>(bench.executive.rung()), static_cast<int>(Rung::kStop));
}

// Proves URH-11.
void a_timestamp_that_stands_is_no_news(void**) {
  UrHalBench& bench = moving();
  int stopped_at = 0;
  for (int i = 1; i <= 20 && stopped_at == 0; ++i)
    if (bench.cycle(0.0) != Status::kOk) stopped_at = i;
  assert_int_equal(stopped_at, 6);
  assert_disabled_by_wire(bench, Status::kBusTimeout);
  assert_reconnects_without_motion(bench);
}

void a_repeated_packet_is_bridged(void**) {
  UrHalBench& bench = moving();
  ASSERT_OK(bench.cycle(0.0));
  ASSERT_OK(bench.cycle(2.0));
  ASSERT_OK(bench.cycles(10));
  assert_int_equal(bench.executive.telemetry().slips, 0);
}

void a_timestamp_that_runs_back_ends_the_motion(void**) {
  for (const double periods : {-1.0, -12400.0}) {
    UrHalBench& bench = moving();
    ASSERT_STATUS(bench.cycle(periods), Status::kClock);
    assert_disabled_by_wire(bench, Status::kClock);
    assert_true(bench.says("the robot's clock jumped to"));
    assert_reconnects_without_motion(bench);
  }
}

}  // namespace
}  // namespace tactus::ur

int main() {
  using namespace tactus::ur;
  const CMUnitTest tests[] = {
      cmocka_unit_test(up_to_five_packets_may_be_missing),
      cmocka_unit_test(from_the_sixth_on_the_wire_is_lost),
      cmocka_unit_test(packets_left_out_walk_the_ladder_as_slips),
      cmocka_unit_test(a_state_is_as_old_as_its_packet),
      cmocka_unit_test(a_state_that_is_too_old_stops_the_arm),
      cmocka_unit_test(a_timestamp_that_stands_is_no_news),
      cmocka_unit_test(a_repeated_packet_is_bridged),
      cmocka_unit_test(a_timestamp_that_runs_back_ends_the_motion),
  };
  const int failed = cmocka_run_group_tests(tests, nullptr, nullptr);
  g_bench.reset();
  return failed;
}
