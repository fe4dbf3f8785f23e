// The way of one drive through the states of CiA 402, against words typed from the standard's
// tables.
#include <cstring>

#include "hal/cia402/drive_machine.hpp"
#include "hal/cia402/protocol_errors.hpp"
#include "tests/support/random.hpp"
#include "tests/support/testing.hpp"

namespace tactus::cia402 {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr DriveTimes kTimes = {100 * kMs, 1000 * kMs, 300 * kMs};

DriveMachine machine() {
  DriveMachine fresh;
  fresh.configure(kTimes);
  return fresh;
}

// Proves CAN-1.
/// Words as drives send them, and the states that they show.
void every_statusword_of_the_standard_is_its_state(void**) {
  struct Row {
    std::uint16_t word;
    State state;
  };
  for (const Row& row :
       {Row{0x0000, State::kNotReadyToSwitchOn}, Row{0x0040, State::kSwitchOnDisabled},
        Row{0x0250, State::kSwitchOnDisabled}, Row{0x0031, State::kReadyToSwitchOn},
        Row{0x0231, State::kReadyToSwitchOn}, Row{0x0033, State::kSwitchedOn},
        Row{0x0233, State::kSwitchedOn}, Row{0x0037, State::kOperationEnabled},
        Row{0x1237, State::kOperationEnabled}, Row{0x0017, State::kQuickStopActive},
        Row{0x000F, State::kFaultReactionActive}, Row{0x0008, State::kFault},
        Row{0x0018, State::kFault}, Row{0x0028, State::kFault}})
    assert_int_equal(state_of(row.word), row.state);
}

/// A word that shows no state enables nothing.
void a_word_that_is_not_in_the_standard_is_not_ready(void**) {
  int strange = 0;
  for (int word = 0; word <= 0xFFFF; ++word) {
    const auto status = static_cast<std::uint16_t>(word);
    if (is_standard(status)) continue;
    ++strange;
    DriveMachine drive = machine();
    assert_int_equal(state_of(status), State::kNotReadyToSwitchOn);
    assert_int_equal(drive.step(status, Goal::kOperationEnabled, 0), 0x0000);
    assert_int_equal(drive.step(status, Goal::kDisabled, 0), 0x0002);
    assert_false(drive.reached());
  }
  assert_in_range(strange, 1, 0xFFFF);
}

void the_way_up_takes_one_command_for_every_state(void**) {
  DriveMachine drive = machine();
  assert_int_equal(drive.step(0x0000, Goal::kSwitchedOn, 0 * kMs), 0x0000);
  assert_int_equal(drive.step(0x0250, Goal::kSwitchedOn, 1 * kMs), 0x0006);
  assert_int_equal(drive.step(0x0231, Goal::kSwitchedOn, 2 * kMs), 0x0007);
  assert_int_equal(drive.step(0x0233, Goal::kSwitchedOn, 3 * kMs), 0x0007);
  assert_true(drive.reached());
  assert_int_equal(drive.step(0x0233, Goal::kOperationEnabled, 4 * kMs), 0x000F);
  assert_false(drive.reached());
  assert_int_equal(drive.step(0x1237, Goal::kOperationEnabled, 5 * kMs), 0x000F);
  assert_true(drive.reached());
}

void the_way_down_is_a_quick_stop_until_the_drive_is_off(void**) {
  DriveMachine drive = machine();
  (void)drive.step(0x1237, Goal::kOperationEnabled, 0);
  assert_int_equal(drive.step(0x1237, Goal::kDisabled, 1 * kMs), 0x0002);
  assert_int_equal(drive.step(0x0017, Goal::kDisabled, 2 * kMs), 0x0002);
  assert_false(drive.reached());
  assert_int_equal(drive.step(0x0250, Goal::kDisabled, 3 * kMs), 0x0000);
  assert_true(drive.reached());
}

void a_quick_stop_that_takes_too_long_loses_its_voltage(void**) {
  DriveMachine drive = machine();
  assert_int_equal(drive.step(0x0017, Goal::kDisabled, 0), 0x0002);
  assert_int_equal(drive.step(0x0017, Goal::kDisabled, 300 * kMs), 0x0002);
  assert_int_equal(drive.step(0x0017, Goal::kDisabled, 301 * kMs), 0x0000);
}

/// One that ended a stop in "quick stop active" goes through "switch on disabled".
void a_drive_in_quick_stop_is_armed_from_below(void**) {
  DriveMachine drive = machine();
  assert_int_equal(drive.step(0x0017, Goal::kSwitchedOn, 0), 0x0000);
  assert_int_equal(drive.step(0x0250, Goal::kSwitchedOn, 1 * kMs), 0x0006);
}

void a_fault_is_reset_by_pulses_of_ten_hertz(void**) {
  DriveMachine drive = machine();
  int edges = 0, since_edge = 1000;
  bool before = false;
  for (int ms = 0; ms < 950; ++ms, ++since_edge) {
    const bool high = drive.step(0x0018, Goal::kSwitchedOn, ms * kMs) == 0x0080;
    if (high && !before) {
      assert_true(since_edge >= 100);
      ++edges;
      since_edge = 0;
    }
    before = high;
    assert_false(drive.late());
  }
  assert_int_equal(edges, 10);
  (void)drive.step(0x0018, Goal::kSwitchedOn, 1001 * kMs);
  assert_true(drive.late());
}

void a_fault_is_never_reset_while_the_drive_is_to_be_disabled(void**) {
  DriveMachine drive = machine();
  for (int ms = 0; ms < 2000; ++ms)
    assert_int_equal(drive.step(0x0018, Goal::kDisabled, ms * kMs), 0x0000);
}

void a_fault_from_before_is_cleared_and_a_new_one_ends_the_way_up(void**) {
  DriveMachine drive = machine();
  (void)drive.step(0x0018, Goal::kSwitchedOn, 0);
  assert_false(drive.faulted());
  (void)drive.step(0x0250, Goal::kSwitchedOn, 1 * kMs);
  assert_false(drive.faulted());
  (void)drive.step(0x000F, Goal::kSwitchedOn, 2 * kMs);
  assert_true(drive.faulted());
  (void)drive.step(0x0018, Goal::kDisabled, 3 * kMs);
  assert_false(drive.faulted());
  (void)drive.step(0x0018, Goal::kSwitchedOn, 4 * kMs);
  assert_false(drive.faulted());
}

void a_state_that_lasts_too_long_is_late(void**) {
  for (const int shown : {0x0000, 0x0250, 0x0231, 0x000F, 0x0017}) {
    const auto word = static_cast<std::uint16_t>(shown);
    DriveMachine drive = machine();
    (void)drive.step(word, Goal::kSwitchedOn, 0);
    (void)drive.step(word, Goal::kSwitchedOn, 100 * kMs);
    assert_false(drive.late());
    (void)drive.step(word, Goal::kSwitchedOn, 100 * kMs + 1);
    assert_true(drive.late());
  }
}

/// Whatever a drive says: it is enabled only from "switched on", and never while it is to be off.
void no_word_enables_a_drive_from_elsewhere(void**) {
  Random random{20161};
  DriveMachine drive = machine();
  std::int64_t now_ns = 0;
  for (int i = 0; i < 200000; ++i) {
    const auto word = static_cast<std::uint16_t>(random.below(0x10000));
    const auto goal = static_cast<Goal>(random.below(3));
    const std::uint16_t command = drive.step(word, goal, now_ns += random.below(51) * kMs);
    const State state = state_of(word);
    if ((command & 0x0008) != 0) {
      assert_int_equal(goal, Goal::kOperationEnabled);
      assert_true(state == State::kSwitchedOn || state == State::kOperationEnabled);
    }
    if (goal == Goal::kDisabled) assert_true(command == 0x0000 || command == 0x0002);
    if ((command & 0x0080) != 0) assert_int_equal(state, State::kFault);
  }
}

void every_error_code_has_a_text(void**) {
  assert_string_equal(error_text(0x8611), "following error");
  assert_string_equal(error_text(0x2310), "continuous over-current");
  assert_string_equal(error_text(0x2311), "current");
  assert_string_equal(error_text(0xFF17), "the manufacturer's own");
  for (int code = 0; code <= 0xFFFF; ++code)
    assert_true(std::strlen(error_text(static_cast<std::uint16_t>(code))) > 0);
}

}  // namespace
}  // namespace tactus::cia402

int main() {
  using namespace tactus::cia402;
  const CMUnitTest tests[] = {
      cmocka_unit_test(every_statusword_of_the_standard_is_its_state),
      cmocka_unit_test(a_word_that_is_not_in_the_standard_is_not_ready),
      cmocka_unit_test(the_way_up_takes_one_command_for_every_state),
      cmocka_unit_test(the_way_down_is_a_quick_stop_until_the_drive_is_off),
      cmocka_unit_test(a_quick_stop_that_takes_too_long_loses_its_voltage),
      cmocka_unit_test(a_drive_in_quick_stop_is_armed_from_below),
      cmocka_unit_test(a_fault_is_reset_by_pulses_of_ten_hertz),
      cmocka_unit_test(a_fault_is_never_reset_while_the_drive_is_to_be_disabled),
      cmocka_unit_test(a_fault_from_before_is_cleared_and_a_new_one_ends_the_way_up),
      cmocka_unit_test(a_state_that_lasts_too_long_is_late),
      cmocka_unit_test(no_word_enables_a_drive_from_elsewhere),
      cmocka_unit_test(every_error_code_has_a_text),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
