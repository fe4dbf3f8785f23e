// Tests the rows of docs/robots/ur10.md's table of faults that arrive as bytes: the cycle of the
// packet that shows the fault ends the motion, and the recovered arm stays where it is; and packets
// that are late, missing, repeated or skipped.
#include <functional>
#include <limits>

#include "tests/ur/hal/ur_moving_bench.hpp"

namespace tactus::ur {
namespace {

using Bytes = std::array<std::uint8_t, 1024>;

struct Spoilt {
  const char* reason;
  /// Spoils a data package; returns the number of bytes to send.
  std::function<std::size_t(Bytes&, std::size_t)> spoil;
};

/// Tells `length`; `sent` bytes are sent.
std::size_t with_length(Bytes& bytes, std::size_t length, std::size_t sent) {
  bytes[0] = static_cast<std::uint8_t>(length >> 8);
  bytes[1] = static_cast<std::uint8_t>(length & 0xff);
  return sent;
}
std::size_t with_recipe(Bytes& bytes, std::size_t size, std::uint8_t recipe) {
  bytes[3] = recipe;
  return size;
}
/// The double `index` of the recipe, after length, type and recipe number.
std::size_t with_double(Bytes& bytes, std::size_t size, std::size_t index, double value) {
  ByteWriter out(bytes.data() + 4 + 8 * index, 8);
  out.f64(value);
  return size;
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

void assert_ends_the_motion(UrHalBench& bench, const Bytes& bytes, std::size_t size,
                            const char* reason) {
  bench.robot.send(bytes.data(), size);
  bench.settings.packet_wait = 500.0;
  ASSERT_STATUS(bench.run_cycle(), Status::kWireFormat);
  assert_disabled_by_wire(bench, Status::kWireFormat);
  assert_true(bench.says(reason));
  assert_reconnects_without_motion(bench);
}

// Proves URH-15, URH-8.
void a_length_size_or_recipe_that_is_not_ours(void**) {
  for (const Spoilt& row :
       {Spoilt{"the length of a packet is outside",
               [](Bytes&bytes, std::size_t size) { return with_length(bytes, 0, size); }},
        Spoilt{"the length of a packet is outside",
               [](Bytes&bytes, std::size_t size) { return with_length(bytes, 2, size); }},
        Spoilt{"the length of a packet is outside",
               [](Bytes&bytes, std::size_t size) { return with_length(bytes, 4097, size); }},
        Spoilt{
            "does not match the recipe",
            [](Bytes&bytes, std::size_t size) { return with_length(bytes, size - 1, size - 1); }},
        Spoilt{
            "does not match the recipe",
            [](Bytes&bytes, std::size_t size) { return with_length(bytes, size + 1, size + 1); }},
        Spoilt{"does not match the recipe",
               [](Bytes&bytes, std::size_t) { return with_length(bytes, 4, 4); }},
        Spoilt{"has the wrong recipe number",
               [](Bytes&bytes, std::size_t size) { return with_recipe(bytes, size, 2); }}}) {
    UrHalBench& bench = moving();
    Bytes bytes{};
    const std::size_t size = row.spoil(bytes, bench.robot.package(bytes.data()));
    assert_ends_the_motion(bench, bytes, size, row.reason);
  }
}

// Proves URH-12, URH-8.
void any_number_of_the_recipe_that_is_none(void**) {
  struct Field {
    std::size_t first, count;
    const char* name;
  };
  for (const Field& field :
       {Field{0, 1, "timestamp"}, Field{1, 6, "target_q"}, Field{7, 6, "actual_q"},
        Field{13, 6, "actual_qd"}, Field{19, 6, "target_moment"}, Field{25, 6, "actual_TCP_pose"},
        Field{31, 6, "actual_TCP_force"}, Field{37, 1, "speed_scaling"},
        Field{38, 1, "target_speed_fraction"}}) {
    UrHalBench& bench = moving();
    Bytes bytes{};
    const std::size_t size = bench.robot.package(bytes.data());
    with_double(bytes, size, field.first + field.count - 1, field.count > 1 ? kNan : -kInfinity);
    assert_ends_the_motion(bench, bytes, size, field.name);
  }
}

// Proves URH-14.
void a_packet_of_an_unknown_type_is_passed_over(void**) {
  UrHalBench& bench = moving();
  constexpr std::array<std::uint8_t, 5> kUnknown = {0, 5, 'Z', 1, 2};
  bench.robot.send(kUnknown.data(), kUnknown.size());
  ASSERT_OK(bench.cycles(5));
}

// Proves URH-10.
void packets_that_come_late_begin_no_cycle(void**) {
  UrHalBench& bench = moving();
  for (int late = 1; late <= 5; ++late) {
    const std::int32_t before = bench.hal.set_points();
    for (int i = 0; i < late; ++i) ASSERT_OK(bench.run_cycle());
    for (int i = 0; i < late; ++i) bench.robot.send_package();
    std::thread next([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      bench.robot.send_package();
    });
    bench.settings.packet_wait = 500.0;
    const double last_s = bench.hal.state().timestamp_s;
    const Status status = bench.run_cycle();
    next.join();
    bench.settings.packet_wait = 1.5;
    ASSERT_OK(status);
    ASSERT_NEAR(bench.hal.state().timestamp_s, last_s + 0.008 * (late + 1), 1e-9);
    bench.robot.set_point(before + late + 1);
    ASSERT_OK(bench.cycles(5));
  }
  assert_int_equal(bench.executive.telemetry().slips, 0);
}

/// A packet that arrives after all must change nothing.
void packets_that_come_after_the_end_change_nothing(void**) {
  UrHalBench& bench = moving();
  for (int i = 1; i <= 6; ++i)
    ASSERT_STATUS(bench.run_cycle(), i < 6 ? Status::kOk : Status::kBusTimeout);
  for (int i = 0; i < 6; ++i) bench.robot.send_package();
  ASSERT_STATUS(bench.cycle(), Status::kBusTimeout);
  assert_disabled_by_wire(bench, Status::kBusTimeout);
  assert_reconnects_without_motion(bench);
}

/// A packet whose stamp is several periods ahead counts as that many missed cycles.
void a_time_stamp_that_jumps_ahead_is_as_many_slips(void**) {
  struct Jump {
    double periods;
    Status expected;
    Rung rung;
  };
  for (const Jump& jump :
       {Jump{4.0, Status::kOk, Rung::kNominal}, Jump{5.0, Status::kSlip, Rung::kHold},
        Jump{8.0, Status::kSlip, Rung::kStop}, Jump{1e6, Status::kSlip, Rung::kStop}}) {
    UrHalBench& bench = moving();
    ASSERT_STATUS(bench.cycle(jump.periods), jump.expected);
    assert_int_equal(static_cast<int>(bench.executive.rung()), static_cast<int>(jump.rung));
  }
}

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
      cmocka_unit_test(a_length_size_or_recipe_that_is_not_ours),
      cmocka_unit_test(any_number_of_the_recipe_that_is_none),
      cmocka_unit_test(a_packet_of_an_unknown_type_is_passed_over),
      cmocka_unit_test(packets_that_come_late_begin_no_cycle),
      cmocka_unit_test(packets_that_come_after_the_end_change_nothing),
      cmocka_unit_test(a_time_stamp_that_jumps_ahead_is_as_many_slips),
      cmocka_unit_test(up_to_five_packets_may_be_missing),
      cmocka_unit_test(from_the_sixth_on_the_wire_is_lost),
      cmocka_unit_test(packets_left_out_walk_the_ladder_as_slips),
      cmocka_unit_test(a_state_is_as_old_as_its_packet),
      cmocka_unit_test(a_state_that_is_too_old_stops_the_arm),
      cmocka_unit_test(a_timestamp_that_stands_is_no_news),
      cmocka_unit_test(a_repeated_packet_is_bridged),
      cmocka_unit_test(a_timestamp_that_runs_back_ends_the_motion),
  };
  return cmocka_run_group_tests(tests, nullptr, end_bench);
}
