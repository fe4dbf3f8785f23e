// Tests the bytes between a UR and its HAL: partial and concatenated packets, the packet that
// begins a cycle, and the conversion of the force.
#include "hal/ur/flange_wrench.hpp"
#include "tests/ur/hal/ur_hal_bench.hpp"

namespace tactus::ur {
namespace {

UrHalBench& started() {
  UrHalBench& bench = g_bench.emplace();
  ASSERT_OK(bench.start());
  return bench;
}

// Proves URH-14.
void a_packet_may_be_cut_at_every_byte(void**) {
  UrHalBench& bench = started();
  std::array<std::uint8_t, 1024> bytes;
  std::size_t size = bench.robot.package(bytes.data());
  bench.robot.send(bytes.data(), size);
  ASSERT_OK(bench.run_cycle());
  const std::uint32_t begun = bench.executive.telemetry().cycles;
  std::uint32_t packets = 0;
  for (std::size_t cut = 1; cut < size; ++cut, ++packets) {
    bench.robot.package(bytes.data());
    bench.robot.send(bytes.data(), cut);
    std::this_thread::sleep_for(std::chrono::microseconds(200));
    std::thread rest([&] {
      std::this_thread::sleep_for(std::chrono::microseconds(300));
      bench.robot.send(bytes.data() + cut, size - cut);
    });
    const Status status = bench.run_cycle();
    rest.join();
    ASSERT_OK(status);
    assert_int_equal(bench.executive.telemetry().slips, 0);
  }
  ASSERT_OK(bench.cycle());
  assert_int_equal(bench.executive.telemetry().cycles, begun + packets + 1);
}

void of_packets_glued_the_newest_counts(void**) {
  UrHalBench& bench = started();
  std::array<std::uint8_t, 2048> bytes;
  const std::size_t size = bench.robot.package(bytes.data());
  bench.robot.change([](FakeImage& image) { image.dq[3] = 0.25; });
  bench.robot.package(bytes.data() + size);
  bench.robot.send(bytes.data(), 2 * size);
  ASSERT_OK(bench.run_cycle());
  ASSERT_NEAR(bench.hal.state().dq[3], 0.25, 0.0);
  assert_int_equal(bench.executive.telemetry().slips, 1);
}

void a_text_message_between_is_passed_over(void**) {
  UrHalBench& bench = started();
  constexpr std::array<std::uint8_t, 15> kHello = {0x00, 0x0f, 0x4d, 0x05, 0x68, 0x65, 0x6c, 0x6c,
                                                   0x6f, 0x04, 0x52, 0x54, 0x44, 0x45, 0x02};
  bench.robot.send(kHello.data(), kHello.size());
  ASSERT_OK(bench.cycle());
}

// Proves URH-15.

/// The bytes that the controller's documentation specifies for these fields, in the order of the
/// HAL's recipe.
void fields_are_where_the_recipe_says(void**) {
  FakeImage image;
  std::array<std::uint8_t, 512> bytes;
  ByteWriter out(bytes.data(), bytes.size());
  double number = 1.0;
  std::size_t doubles = 0;
  for (const RecipeField& field : kOutputFields) {
    const std::size_t count = size_of(field.type) / 8;
    for (std::size_t i = 0; i < count; ++i, ++doubles) out.f64(number++);
    if (field.type == FieldType::kInt32 || field.type == FieldType::kUint32)
      out.i32(static_cast<std::int32_t>(number++));
  }
  assert_int_equal(doubles, 39 + 10);
  ByteReader in(out.data(), out.size());
  UrState state;
  Message why;
  ASSERT_OK(decode_state(in, {true, true, true}, state, why));
  ASSERT_NEAR(state.timestamp_s, 1.0, 0.0);
  ASSERT_NEAR(state.target_q[0], 2.0, 0.0);
  ASSERT_NEAR(state.q[5], 13.0, 0.0);
  ASSERT_NEAR(state.dq[0], 14.0, 0.0);
  ASSERT_NEAR(state.moment[0], 20.0, 0.0);
  ASSERT_NEAR(state.tcp_pose[0], 26.0, 0.0);
  ASSERT_NEAR(state.tcp_force[5], 37.0, 0.0);
  ASSERT_NEAR(state.speed_scaling, 38.0, 0.0);
  ASSERT_NEAR(state.speed_fraction, 39.0, 0.0);
  assert_int_equal(state.robot_mode, 40);
  assert_int_equal(state.safety_mode, 41);
  assert_int_equal(state.echo, 42);
  assert_int_equal(state.safety_bits, 43);
  assert_int_equal(state.runtime_state, 44);
  ASSERT_NEAR(state.tcp_offset[0], 45.0, 0.0);
  ASSERT_NEAR(state.payload_kg, 51.0, 0.0);
  ASSERT_NEAR(state.payload_com[2], 54.0, 0.0);
}

void a_reader_goes_to_the_last_byte_and_no_further(void**) {
  constexpr std::array<std::uint8_t, 9> kBytes = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  const auto read = [](ByteReader& in, std::size_t count) -> std::uint64_t {
    return count == 1 ? in.u8() : count == 2 ? in.u16() : count == 4 ? in.u32() : in.u64();
  };
  for (const std::size_t count : {1, 2, 4, 8}) {
    for (std::size_t size = 0; size <= 8; ++size) {
      ByteReader number(kBytes.data(), size), text(kBytes.data(), size);
      const std::uint64_t value = read(number, count);
      assert_true(number.ok() == (size >= count) && (value != 0) == (size >= count));
      assert_true(number.done() == (size == count));
      assert_int_equal(number.left(), size >= count ? size - count : 0);
      assert_int_equal(text.text(count).size(), size >= count ? count : 0);
      assert_true(text.ok() == (size >= count) && text.done() == (size == count));
    }
    ByteReader behind(kBytes.data(), 8);
    behind.u8();
    assert_true((read(behind, count) != 0) == (count < 8));
    while (behind.ok()) behind.u8();
    assert_true(behind.u8() == 0 && behind.rest().empty() && !behind.done());
  }
}

// Proves URH-16.
void one_cycle_for_every_period_whatever_is_lost(void**) {
  using Arrival = PacketClock::Arrival;
  constexpr std::int64_t kPeriod_ns = 8'000'000;
  PacketClock clock;
  clock.start(100.0, kPeriod_ns);
  assert_true(clock.packet(100.008) == Arrival::kCycle);
  clock.bridge();  // 100.016
  clock.bridge();  // 100.024
  assert_int_equal(clock.missed(), 2);
  assert_int_equal(clock.stamp_ns(), 100'024'000'000);
  assert_true(clock.packet(100.016) == Arrival::kLate);
  assert_true(clock.packet(100.016) == Arrival::kRepeated);
  assert_true(clock.packet(100.024) == Arrival::kLate);
  assert_true(clock.packet(100.032) == Arrival::kCycle);
  assert_int_equal(clock.missed(), 0);
  assert_int_equal(clock.stamp_ns(), 100'032'000'000);
  assert_true(clock.packet(100.031) == Arrival::kBackwards);
  assert_true(clock.packet(0.008) == Arrival::kBackwards);
}

// Proves URH-10.

/// The HAL waits a period and a half for a packet after another packet, and half a period less
/// after a cycle that has already waited that long.
void a_cycle_after_a_bridged_one_waits_half_a_period_less(void**) {
  PacketClock clock;
  clock.start(100.0, 8'000'000);
  assert_int_equal(clock.patience_ns(1.5), 12'000'000);
  for (int i = 0; i < 3; ++i) {
    clock.bridge();
    assert_int_equal(clock.patience_ns(1.5), 8'000'000);
  }
  clock.packet(100.008);  // late, but the wire works again
  assert_int_equal(clock.patience_ns(1.5), 12'000'000);
}

// Proves URH-17.

/// A tool of 2 kg whose centre of mass is at 0.1 m and whose tip is at 0.2 m on the flange's axis;
/// a push at the tip has a lever. Of a flange that points down, half a turn about x, the weight is
/// along its z axis. One held sideways, a quarter turn about y, feels it along its x axis, with the
/// lever of the centre of mass. A payload beside the axis has a lever too.
void the_force_at_the_tip_is_moved_to_the_flange(void**) {
  constexpr double kHalf = 3.14159265358979312, kWeight = 2.0 * 9.81;
  struct Row {
    double turn[3], force[6];
    Tool tool;
    Version version;
    double expected[6];
  };
  const Tool long_tool = {2.0, {0.0, 0.0, 0.1}, Pose{{0.0, 0.0, 0.2}, {1.0, 0.0, 0.0, 0.0}}};
  const Row rows[] = {
      {{kHalf, 0, 0}, {10, 0, 0, 0, 0, 3}, long_tool, {}, {10, 0, kWeight, 0, 0.2 * 10, -3}},
      // the same as an e-Series reports it: its moment is about the flange already
      {{kHalf, 0, 0},
       {10, 0, 0, 0, -0.2 * 10, 3},
       long_tool,
       {5, 11, 1, 108318},
       {10, 0, kWeight, 0, 0.2 * 10, -3}},
      {{0, 0.5 * kHalf, 0},
       {0, 0, 5, 0, 0, 3},
       long_tool,
       {},
       {kWeight - 5, 0, 0, -3, 0.1 * kWeight - 0.2 * 5, 0}},
      {{0, 0, 0}, {}, {1.0, {0.1, 0.0, 0.0}, {}}, {}, {0, 0, -9.81, 0, 0.981, 0}}};
  for (const Row& row : rows) {
    UrState state;
    state.tcp_pose << 0.5, 0.0, 0.5, Vector3(row.turn);
    state.tcp_force = Vector6(row.force);
    const Vector6 wrench = flange_wrench(state, row.tool, row.version);
    for (int i = 0; i < 6; ++i) ASSERT_NEAR(wrench[i], row.expected[i], 1e-12);
  }
}

}  // namespace
}  // namespace tactus::ur

int main() {
  using namespace tactus::ur;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_packet_may_be_cut_at_every_byte),
      cmocka_unit_test(of_packets_glued_the_newest_counts),
      cmocka_unit_test(a_text_message_between_is_passed_over),
      cmocka_unit_test(fields_are_where_the_recipe_says),
      cmocka_unit_test(a_reader_goes_to_the_last_byte_and_no_further),
      cmocka_unit_test(one_cycle_for_every_period_whatever_is_lost),
      cmocka_unit_test(a_cycle_after_a_bridged_one_waits_half_a_period_less),
      cmocka_unit_test(the_force_at_the_tip_is_moved_to_the_flange),
  };
  return cmocka_run_group_tests(tests, nullptr, end_bench);
}
