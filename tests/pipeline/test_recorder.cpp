// Tests the recorder: rows come out as they went in; a full ring drops the new row and reports it.
#include "kernel/pipeline/recorder.hpp"

#include <thread>

#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr int kWidth = 1 + kDof;  // time and one joint signal
constexpr std::size_t kRows = 3;

/// One joint signal and a ring of three rows; the numbers after the ring are a fence.
struct Bench {
  static constexpr double kFence = -77.0;

  JointVector q = JointVector::Zero();
  PortEntry port{Name("robot"), "q", Quantity::kJointPosition, &q};
  std::array<double, kRows * kWidth + kWidth> storage;
  Recorder recorder{storage.data(), kRows* kWidth + kWidth - 1};  // almost room for a fourth
  std::array<double, kWidth> row{};

  Bench() {
    storage.fill(kFence);
    Recording recording;
    recording.signals[0] = &port;
    recording.signal_count = 1;
    recorder.start(recording);
  }
  void record(int number) {
    for (int i = 0; i < kDof; ++i) q[i] = 10 * number + i;
    recorder.record(number);
  }
  void next_is(int number) {
    assert_true(recorder.take(row.data()));
    assert_true(row[0] == number);
    for (int i = 0; i < kDof; ++i)
      assert_true(row[static_cast<std::size_t>(i + 1)] == 10 * number + i);
  }
  void assert_empty() { assert_false(recorder.take(row.data())); }
  void assert_fence() const {
    for (std::size_t i = kRows * kWidth; i < storage.size(); ++i) assert_true(storage[i] == kFence);
  }
};

// Proves REC-1.

void nothing_comes_out_of_an_empty_ring(void**) {
  Bench bench;
  bench.assert_empty();
  assert_int_equal(bench.recorder.dropped(), 0);
}

void rows_come_out_as_they_went_in(void**) {
  Bench bench;
  for (int round = 0; round < 100; ++round) {  // many times around the ring
    bench.record(2 * round);
    bench.record(2 * round + 1);
    bench.next_is(2 * round);
    bench.next_is(2 * round + 1);
    bench.assert_empty();
  }
  assert_int_equal(bench.recorder.dropped(), 0);
  bench.assert_fence();
}

void a_full_ring_drops_the_new_row_and_counts_it(void**) {
  Bench bench;
  for (int round = 0; round < 10; ++round) {
    for (int number = 0; number < 8; ++number) bench.record(number);
    assert_int_equal(bench.recorder.dropped(), 5 * (round + 1));
    for (int number = 0; number < 3; ++number) bench.next_is(number);
    bench.assert_empty();
    bench.assert_fence();
  }
}

void a_row_taken_makes_room_for_one(void**) {
  Bench bench;
  for (int number = 0; number < 3; ++number) bench.record(number);
  for (int number = 3; number < 50; ++number) {
    bench.next_is(number - 3);
    bench.record(number);
    assert_int_equal(bench.recorder.dropped(), number - 3);
    bench.record(1000);  // one too many
    assert_int_equal(bench.recorder.dropped(), number - 2);
  }
}

void a_start_empties_the_ring(void**) {
  Bench bench;
  Recording recording;
  recording.signals[0] = &bench.port;
  recording.signal_count = 1;
  for (int number = 0; number < 5; ++number) bench.record(number);
  bench.recorder.start(recording);
  bench.assert_empty();
  assert_int_equal(bench.recorder.dropped(), 0);
  bench.record(7);
  bench.next_is(7);
}

void a_ring_too_small_for_a_row_drops_every_row(void**) {
  Bench bench;
  Recorder small(bench.storage.data(), kWidth - 1);
  Recording recording;
  recording.signals[0] = &bench.port;
  recording.signal_count = 1;
  small.start(recording);
  small.record(0.0);
  assert_int_equal(small.dropped(), 1);
  assert_false(small.take(bench.row.data()));
  assert_true(bench.storage[0] == Bench::kFence);
}

void a_recording_without_signals_is_the_time(void**) {
  std::array<double, 4> storage;
  Recorder recorder(storage.data(), storage.size());
  recorder.start(Recording());
  assert_int_equal(Recording().width(), 1);
  double row = 0.0;
  for (const double time_s : {1.0, 2.0, 3.0, 4.0}) recorder.record(time_s);
  for (const double time_s : {1.0, 2.0, 3.0, 4.0}) {
    assert_true(recorder.take(&row));
    assert_true(row == time_s);
  }
}

void a_pose_is_x_y_z_qw_qx_qy_qz(void**) {
  const Pose pose = {{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0, 7.0}};  // w x y z
  const PortEntry port = {Name("model"), "x", Quantity::kPose, &pose};
  double numbers[7];
  assert_int_equal(flatten(port, numbers), 7);
  for (int i = 0; i < 7; ++i) assert_true(numbers[i] == i + 1);
}

void a_twist_is_linear_part_first_and_joints_are_in_order(void**) {
  const Vector6 twist = Vector6::LinSpaced(1.0, 6.0);
  const JointVector q = JointVector::LinSpaced(1.0, kDof);
  double numbers[kDof];
  for (const Quantity of_tip :
       {Quantity::kTwist, Quantity::kTaskAcceleration, Quantity::kWrench, Quantity::kWrenchRate}) {
    assert_int_equal(flatten({Name("model"), "v", of_tip, &twist}, numbers), 6);
    for (int i = 0; i < 6; ++i) assert_true(numbers[i] == i + 1);
  }
  for (const Quantity joints : {Quantity::kJointPosition, Quantity::kJointVelocity,
                                Quantity::kJointAcceleration, Quantity::kJointEffort}) {
    assert_int_equal(flatten({Name("robot"), "q", joints, &q}, numbers), kDof);
    for (int i = 0; i < kDof; ++i) assert_true(numbers[i] == i + 1);
  }
}

void a_flag_is_one_when_it_is_set(void**) {
  for (const bool flag : {false, true}) {
    double number = 5.0;
    assert_int_equal(flatten({Name("ac"), "limited", Quantity::kFlag, &flag}, &number), 1);
    assert_true(number == (flag ? 1.0 : 0.0));
  }
}

void what_is_not_recorded_has_no_numbers(void**) {
  const Tool tool;
  const Jacobian J = Jacobian::Zero();
  double untouched = 5.0;
  assert_int_equal(flatten({Name("robot"), "tool", Quantity::kTool, &tool}, &untouched), 0);
  assert_int_equal(flatten({Name("model"), "J", Quantity::kJacobian, &J}, &untouched), 0);
  assert_true(untouched == 5.0);
}

void the_width_is_the_time_and_every_number_of_every_signal(void**) {
  const Pose pose;
  const JointVector q = JointVector::Zero();
  const Tool tool;
  const PortEntry of_pose = {Name("model"), "x", Quantity::kPose, &pose};
  const PortEntry of_q = {Name("robot"), "q", Quantity::kJointPosition, &q};
  const PortEntry of_tool = {Name("robot"), "tool", Quantity::kTool, &tool};
  Recording recording;
  recording.signals = {&of_pose, &of_q, &of_tool};
  recording.signal_count = 3;
  assert_int_equal(recording.width(), 1 + 7 + kDof + 0);
}

constexpr int kPassed = 100000;
Bench g_bench;
struct Findings {
  int taken = 0, torn = 0;
  double last = -1.0;
  bool ordered = true;
} g_findings;

void record_all() {
  for (int number = 0; number < kPassed; ++number) g_bench.record(number);
}

void drain() {
  while (g_bench.recorder.take(g_bench.row.data())) {
    const std::array<double, kWidth>& row = g_bench.row;
    ++g_findings.taken;
    g_findings.ordered = g_findings.ordered && row[0] > g_findings.last;
    g_findings.last = row[0];
    for (std::size_t i = 1; i < kWidth; ++i)
      g_findings.torn += row[i] != 10.0 * row[0] + static_cast<double>(i) - 1.0;
  }
}

void between_two_threads_every_row_is_whole_and_either_taken_or_counted(void**) {
  {
    std::thread writer(record_all);
    while (g_findings.taken + static_cast<int>(g_bench.recorder.dropped()) < kPassed) drain();
    writer.join();
  }
  drain();
  assert_int_equal(g_findings.taken + static_cast<int>(g_bench.recorder.dropped()), kPassed);
  assert_int_equal(g_findings.torn, 0);
  assert_true(g_findings.ordered && g_findings.taken > 0);
  g_bench.assert_fence();
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(nothing_comes_out_of_an_empty_ring),
      cmocka_unit_test(rows_come_out_as_they_went_in),
      cmocka_unit_test(a_full_ring_drops_the_new_row_and_counts_it),
      cmocka_unit_test(a_row_taken_makes_room_for_one),
      cmocka_unit_test(a_start_empties_the_ring),
      cmocka_unit_test(a_ring_too_small_for_a_row_drops_every_row),
      cmocka_unit_test(a_recording_without_signals_is_the_time),
      cmocka_unit_test(a_pose_is_x_y_z_qw_qx_qy_qz),
      cmocka_unit_test(a_twist_is_linear_part_first_and_joints_are_in_order),
      cmocka_unit_test(a_flag_is_one_when_it_is_set),
      cmocka_unit_test(what_is_not_recorded_has_no_numbers),
      cmocka_unit_test(the_width_is_the_time_and_every_number_of_every_signal),
      cmocka_unit_test(between_two_threads_every_row_is_whole_and_either_taken_or_counted),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
