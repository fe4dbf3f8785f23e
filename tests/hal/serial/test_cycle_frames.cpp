// The payloads of the cycle: every bit of a state and of a command arrives, and nothing else
// passes.
#include <cstring>
#include <random>

#include "hal/serial/cycle_frames.hpp"
#include "tests/support/testing.hpp"

namespace tactus::serial {
namespace {

std::mt19937_64 g_random(2);
std::uint8_t g_bytes[600];

/// Any bits: also infinities, zeros of both signs and what is no number.
double any_double() {
  constexpr double kSome[] = {0.0, -0.0, HUGE_VAL, -HUGE_VAL, 5e-324};
  const std::uint64_t bits = g_random();
  double value;
  std::memcpy(&value, &bits, sizeof value);
  return bits % 7 == 0 ? kSome[bits / 7 % 5] : value;
}

template <class Vector>
void fill(Vector& values) {
  for (int i = 0; i < values.size(); ++i) values[i] = any_double();
}

RobotState any_state() {
  RobotState state;
  fill(state.q);
  fill(state.dq);
  fill(state.tau);
  fill(state.ft);
  state.speed_scaling = any_double();
  state.stamp_ns = static_cast<std::int64_t>(g_random());
  for (Drive& drive : state.drives) {
    drive.state = static_cast<DriveState>(g_random() % 6);
    drive.valid = g_random() % 2 == 0;
    drive.warns = g_random() % 2 == 0;
    drive.reason = static_cast<Status>(g_random() % 256);
    drive.code = static_cast<std::uint32_t>(g_random());
  }
  return state;
}

template <class Vector>
void assert_same_bits(const Vector& a, const Vector& b) {
  assert_memory_equal(a.data(), b.data(), sizeof a);
}

// Proves LNK-2.
void every_bit_of_a_state_arrives(void**) {
  for (int trial = 0; trial < 500; ++trial) {
    const RobotState state = any_state();
    ByteWriter writer(g_bytes, sizeof g_bytes);
    write_state(writer, Order::kArmed, state);
    ByteReader reader(g_bytes, writer.size());
    RobotState read;
    Order order = Order::kDisabled;
    assert_true(read_state(reader, order, read));
    assert_true(order == Order::kArmed);
    assert_same_bits(read.q, state.q);
    assert_same_bits(read.dq, state.dq);
    assert_same_bits(read.tau, state.tau);
    assert_same_bits(read.ft, state.ft);
    assert_memory_equal(&read.speed_scaling, &state.speed_scaling, sizeof(double));
    assert_true(read.stamp_ns == state.stamp_ns);
    for (std::size_t j = 0; j < read.drives.size(); ++j) {
      assert_true(read.drives[j].state == state.drives[j].state);
      assert_true(read.drives[j].valid == state.drives[j].valid);
      assert_true(read.drives[j].warns == state.drives[j].warns);
      assert_true(read.drives[j].reason == state.drives[j].reason);
      assert_true(read.drives[j].code == state.drives[j].code);
    }
  }
}

void every_bit_of_a_result_arrives(void**) {
  for (int trial = 0; trial < 500; ++trial) {
    CycleResult result;
    result.cycle = static_cast<std::uint32_t>(g_random());
    result.stamp_ns = static_cast<std::int64_t>(g_random());
    result.command.mode = static_cast<CommandMode>(g_random() % 3);
    result.command.request = static_cast<DriveRequest>(g_random() % 3);
    fill(result.command.value);
    fill(result.command.dq_ff);
    fill(result.command.tau_ff);
    result.status = static_cast<Status>(g_random() % 256);
    result.rung = static_cast<std::uint8_t>(g_random());
    result.reports = static_cast<std::uint8_t>(g_random());
    result.row = g_random();
    ByteWriter writer(g_bytes, sizeof g_bytes);
    write_result(writer, result);
    ByteReader reader(g_bytes, writer.size());
    CycleResult read;
    assert_true(read_result(reader, read));
    assert_int_equal(read.cycle, result.cycle);
    assert_true(read.stamp_ns == result.stamp_ns && read.row == result.row);
    assert_true(read.command.mode == result.command.mode);
    assert_true(read.command.request == result.command.request);
    assert_same_bits(read.command.value, result.command.value);
    assert_same_bits(read.command.dq_ff, result.command.dq_ff);
    assert_same_bits(read.command.tau_ff, result.command.tau_ff);
    assert_true(read.status == result.status);
    assert_int_equal(read.rung, result.rung);
    assert_int_equal(read.reports, result.reports);
  }
}

void a_payload_of_another_length_or_robot_changes_nothing(void**) {
  ByteWriter writer(g_bytes, sizeof g_bytes);
  write_state(writer, Order::kArmed, any_state());
  for (std::size_t size = 0; size <= writer.size() + 8; ++size) {
    if (size == writer.size()) continue;
    ByteReader reader(g_bytes, size);
    RobotState read;
    Order order = Order::kDisabled;
    assert_false(read_state(reader, order, read));
    assert_true(order == Order::kDisabled && read.stamp_ns == 0 && read.q.isZero(0.0));
  }
}

void a_drive_state_or_an_order_that_does_not_exist_is_refused(void**) {
  ByteWriter writer(g_bytes, sizeof g_bytes);
  write_state(writer, Order::kArmed, RobotState());
  const std::size_t size = writer.size(), last_drive = size - 7;
  for (const std::size_t at : {std::size_t{0}, last_drive}) {
    const std::uint8_t before = g_bytes[at];
    for (const int value : {at == 0 ? 2 : 6, 200, 255}) {
      g_bytes[at] = static_cast<std::uint8_t>(value);
      ByteReader reader(g_bytes, size);
      RobotState read;
      Order order;
      assert_false(read_state(reader, order, read));
    }
    g_bytes[at] = before;
  }
}

}  // namespace
}  // namespace tactus::serial

int main() {
  using namespace tactus::serial;
  const CMUnitTest tests[] = {
      cmocka_unit_test(every_bit_of_a_state_arrives),
      cmocka_unit_test(every_bit_of_a_result_arrives),
      cmocka_unit_test(a_payload_of_another_length_or_robot_changes_nothing),
      cmocka_unit_test(a_drive_state_or_an_order_that_does_not_exist_is_refused),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
