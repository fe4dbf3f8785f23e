// Tests the executive with drives that need cycles, fail or send nothing new: arming, the age of
// the state, faults of one joint, and the rate of late cycles.
#include "tests/cycle/ladder_bench.hpp"

namespace tactus {
namespace {

using Bench = ExecutiveBench;

/// Drives that do not obey by themselves: the test says when they are enabled.
Bench& slow_drives(std::string_view text = kPositions) {
  Bench& b = fresh_bench(text);
  b.hal.obeys = false;
  ASSERT_OK(b.executive.start());
  ASSERT_STATUS(b.executive.arm(), Status::kArming);
  static_cast<void>(b.hal.diary());
  return b;
}

// Proves LAD-14.

void the_exchange_goes_on_while_drives_are_disabled_armed_and_enabled(void**) {
  Bench& b = slow_drives();
  for (int i = 0; i < 300; ++i) {
    if (i == 200) b.hal.all(DriveState::kEnabled);
    ASSERT_STATUS(b.cycle(), Status::kArming);
    assert_string_equal(b.hal.diary(), "ra");
    const Status status = b.executive.arm();
    if (status == Status::kOk) {
      assert_in_range(i, 200, 200 + RestWatch::kCycles);
      break;
    }
    ASSERT_STATUS(status, Status::kArming);
  }
  assert_true(b.executive.rung() == Rung::kNominal);
  ASSERT_OK(b.cycle());
  assert_string_equal(b.hal.diary(), "rw");
  b.executive.halt();
  while (b.executive.rung() != Rung::kDisabled) ASSERT_STATUS(b.cycle(), Status::kHalted);
  static_cast<void>(b.hal.diary());
  for (int i = 0; i < 10; ++i) {
    assert_true(b.executive.busy());  // the drives are not disabled yet
    assert_true(b.executive.next_ns() == b.now_ns + Bench::kPeriod_ns);
    ASSERT_STATUS(b.cycle(), Status::kHalted);
    assert_string_equal(b.hal.diary(), "rd");
  }
  ASSERT_STATUS(b.executive.arm(), Status::kNotAtRest);
  b.hal.all(DriveState::kDisabled);
  ASSERT_STATUS(b.cycle(), Status::kHalted);
  assert_false(b.executive.busy());
}

void drives_that_are_not_armed_in_time_are_given_up(void**) {
  Bench& b = slow_drives();
  b.hal.all(DriveState::kArming);
  int cycles = 0;
  while (b.cycle() == Status::kArming) ++cycles;
  assert_int_equal(cycles, 9999);  // of 10 s
  assert_event(b, Cause::kArmTime, Status::kArmingTime, Rung::kArming, Rung::kDisabled);
  assert_int_equal(last_event(b).joint, 0);

  Bench& moving = slow_drives();
  moving.hal.all(DriveState::kEnabled);
  moving.hal.state.dq[3] = -0.5;
  while (moving.cycle() == Status::kArming) ASSERT_STATUS(moving.executive.arm(), Status::kArming);
  assert_event(moving, Cause::kArmTime, Status::kNotAtRest, Rung::kArming, Rung::kDisabled);
  assert_true(last_event(moving).joint == 3 && last_event(moving).value == -0.5F);
}

void drives_that_are_not_disabled_in_time_are_in_the_log(void**) {
  Bench& b = started();
  ASSERT_OK(b.cycle());
  b.hal.obeys = false;
  b.executive.halt();
  while (b.executive.rung() != Rung::kDisabled) ASSERT_STATUS(b.cycle(), Status::kHalted);
  int cycles = 0;
  for (; b.executive.busy(); ++cycles) ASSERT_STATUS(b.cycle(), Status::kHalted);
  assert_int_equal(cycles, 2000);  // of 2 s
  assert_event(b, Cause::kStopTime, Status::kStopTime, Rung::kDisabled, Rung::kDisabled);
}

void a_joint_that_cannot_be_armed_is_named_with_its_drives_code(void**) {
  Bench& b = slow_drives();
  ASSERT_STATUS(b.cycle(), Status::kArming);
  b.hal.state.drives[4] = {DriveState::kFault, true, Status::kNotReferenced, false, 0x7306};
  ASSERT_STATUS(b.cycle(), Status::kNotReferenced);
  assert_event(b, Cause::kDrive, Status::kNotReferenced, Rung::kArming, Rung::kDisabled);
  assert_int_equal(last_event(b).joint, 4);
  assert_int_equal(last_event(b).code, 0x7306);
  ASSERT_STATUS(b.cycle(), Status::kNotReferenced);
}

Event event_at(const Bench& b, std::uint32_t from_last) {
  Event event;
  assert_true(b.executive.events().read(b.executive.events().count() - 1 - from_last, event));
  return event;
}

// Proves LAD-15.
void faults_from_before_an_arming_are_told_once_for_every_joint_that_had_one(void**) {
  Bench& b = fresh_bench(kPositions);
  for (int arming = 0; arming < 2; ++arming) {
    b.hal.obeys = false;
    b.hal.all(DriveState::kDisabled);
    b.hal.state.drives[0] = {DriveState::kFault, true, Status::kOk, false, 0};
    b.hal.state.drives[5] = {DriveState::kFault, true, Status::kProtectiveStop, false, 0x7500};
    if (arming == 0) ASSERT_OK(b.executive.start());
    const std::uint32_t before = b.executive.events().count();
    if (arming == 1) ASSERT_STATUS(b.cycle(), Status::kHalted);  // it came between two armings
    assert_int_equal(b.executive.events().count(), before);
    ASSERT_STATUS(b.executive.arm(), Status::kArming);
    ASSERT_STATUS(b.cycle(), Status::kArming);
    assert_int_equal(b.executive.events().count(), before + 3);
    const Event first = event_at(b, 1), second = event_at(b, 0);
    assert_true(first.cause == Cause::kOldFault && second.cause == Cause::kOldFault);
    assert_true(first.joint == 0 && second.joint == 5 && second.code == 0x7500);
    ASSERT_STATUS(first.status, Status::kDriveFault);
    ASSERT_STATUS(second.status, Status::kProtectiveStop);
    assert_true(second.from == Rung::kArming && second.to == Rung::kArming);
    b.hal.all(DriveState::kArming);  // the drives are cleared
    for (int i = 0; i < 5; ++i) ASSERT_STATUS(b.cycle(), Status::kArming);
    assert_int_equal(b.executive.events().count(), before + 3);
    b.executive.halt();
    b.hal.all(DriveState::kDisabled);
    for (int i = 0; i < 3; ++i) ASSERT_STATUS(b.cycle(), Status::kHalted);
  }
}

// Proves LAD-16.
/// One that stands, or flickers, until the next arming is not told in that again.
void a_warning_stops_nothing_and_is_told_once_in_an_arming(void**) {
  Bench& b = fresh_bench(kPositions);
  b.hal.state.drives[3].warns = true;
  ASSERT_OK(b.executive.start());
  ASSERT_STATUS(b.cycle(), Status::kNotStarted);
  assert_int_equal(b.executive.events().count(), 0);  // nobody has asked for the drives
  for (int arming = 0; arming < 3; ++arming) {
    if (arming == 1) {
      for (Drive& drive : b.hal.state.drives) drive.warns = false;
      ASSERT_STATUS(b.cycle(), Status::kHalted);
    }
    ASSERT_STATUS(b.executive.arm(), Status::kArming);
    int told = 0;
    std::uint32_t read = b.executive.events().count();
    for (int i = 0; i < 300; ++i) {
      for (const std::size_t joint : {std::size_t{3}, std::size_t{6}}) {
        b.hal.state.drives[joint].warns = joint == 3 ? i % 7 != 3 : i > 200;
        b.hal.state.drives[joint].code = 0x4210;
      }
      const Status status = b.cycle();
      if (status == Status::kArming) static_cast<void>(b.executive.arm());
      Event event;
      for (; b.executive.events().read(read, event); ++read) {
        if (event.cause != Cause::kWarning) continue;
        assert_int_equal(event.joint, told++ == 0 ? 3 : 6);
        assert_true(event.code == 0x4210 && event.status == Status::kOk && event.from == event.to);
      }
    }
    assert_int_equal(told, arming < 2 ? 2 : 0);
    assert_true(b.executive.rung() == Rung::kNominal);
    b.executive.halt();
    while (b.executive.rung() != Rung::kDisabled || b.executive.busy()) {
      for (const std::size_t joint : {std::size_t{3}, std::size_t{6}})
        b.hal.state.drives[joint].warns = true;
      ASSERT_STATUS(b.cycle(), Status::kHalted);
    }
  }
}

void a_drive_that_leaves_enabled_disables_all_in_every_mode(void**) {
  for (const std::string_view text : {kPositions, kVelocities, kExecutivePipeline}) {
    for (const DriveState state : {DriveState::kUnknown, DriveState::kDisabled, DriveState::kArming,
                                   DriveState::kStopping, DriveState::kFault}) {
      Bench& b = started(text);
      ASSERT_OK(b.cycle());
      b.hal.obeys = false;
      b.hal.state.drives[2] = {state, true, Status::kOk, false, 42};
      ASSERT_STATUS(b.cycle(), Status::kDriveFault);
      assert_event(b, Cause::kDrive, Status::kDriveFault, Rung::kNominal, Rung::kDisabled);
      assert_true(last_event(b).joint == 2 && last_event(b).code == 42);
    }
  }
}

/// The exchange goes on over a wire that works again; nothing but arm() leads up.
void after_a_wire_that_failed_arming_is_refused_until_it_works(void**) {
  Bench& b = started();
  ASSERT_OK(b.cycle());
  b.hal.read_status = Status::kBusTimeout;
  ASSERT_STATUS(b.cycle(), Status::kBusTimeout);
  ASSERT_STATUS(b.executive.arm(), Status::kBusTimeout);
  assert_event(b, Cause::kRefused, Status::kBusTimeout, Rung::kDisabled, Rung::kDisabled);
  b.hal.read_status = Status::kOk;
  ASSERT_STATUS(b.cycle(), Status::kBusTimeout);
  ASSERT_OK(armed(b.executive, Bench::kPeriod_ns, b.now_ns));
}

/// A state that was sampled before the request does not tell that the drives are down.
void drives_that_had_a_cycle_to_arm_are_waited_for(void**) {
  Bench& b = fresh_bench(kPositions);
  b.pipeline.executive.arming_ms = 1;
  b.hal.obeys = false;
  ASSERT_OK(b.executive.start());
  ASSERT_STATUS(b.executive.arm(), Status::kArming);
  ASSERT_STATUS(b.cycle(), Status::kArmingTime);
  assert_true(b.executive.busy());
  b.hal.all(DriveState::kStopping);
  ASSERT_STATUS(b.cycle(), Status::kArmingTime);
  assert_true(b.executive.busy());
  b.hal.all(DriveState::kDisabled);
  ASSERT_STATUS(b.cycle(), Status::kArmingTime);
  assert_false(b.executive.busy());
}

/// Without a start there is no wire and no period.
void before_a_start_nothing_is_exchanged(void**) {
  Bench& b = fresh_bench(kPositions);
  ASSERT_STATUS(b.cycle(), Status::kNotStarted);
  ASSERT_STATUS(b.executive.arm(), Status::kNotStarted);
  ASSERT_STATUS(b.cycle(), Status::kNotStarted);
  assert_string_equal(b.hal.diary(), "");
}

void a_start_on_a_higher_rung_is_a_stop_in_the_log(void**) {
  Bench& b = started();
  ASSERT_OK(b.cycle());
  ASSERT_OK(b.executive.start());
  const Event event = last_event(b);
  assert_true(event.cause == Cause::kOff && event.from == Rung::kNominal);
  assert_true(event.to == Rung::kDisabled && b.executive.rung() == Rung::kDisabled);
}

/// Before the arm was ever taken over.
void a_request_to_disabled_drives_is_refused_at_once(void**) {
  Bench& b = fresh_bench(kPositions);
  ASSERT_OK(b.executive.start());
  JointSpace::Point point;
  point.q = b.hal.state.q;
  std::uint32_t id = 0;
  assert_true(b.client.send(point, id).ok());
  ASSERT_STATUS(b.cycle(), Status::kNotStarted);
  const Report report = final_report(b, id);
  assert_true(report.outcome == Outcome::kRefused);
  ASSERT_STATUS(report.verdict.status, Status::kNotStarted);
}

// Proves GRD-11.

void a_state_that_does_not_change_is_bridged_for_five_periods_and_no_longer(void**) {
  for (const std::string_view text : {kPositions, kVelocities, kExecutivePipeline}) {
    for (const int age : {0, 5, 6, 1000}) {
      Bench& b = started(text);
      ASSERT_OK(b.cycle());
      b.hal.delay_ns = age * Bench::kPeriod_ns;
      ASSERT_STATUS(b.cycle(), age <= 5 ? Status::kOk : Status::kStateStale);
      if (age > 5) assert_true(last_event(b).value == static_cast<float>(age));
    }
    Bench& future = started(text);
    future.hal.delay_ns = -2 * Bench::kPeriod_ns;
    ASSERT_STATUS(future.cycle(), Status::kStateStale);
  }
}

void a_joint_that_is_not_measured_is_named(void**) {
  Bench& b = started();
  ASSERT_OK(b.cycle());
  b.hal.obeys = false;
  b.hal.state.drives[3].valid = false;
  ASSERT_STATUS(b.cycle(), Status::kStateInvalid);
  assert_event(b, Cause::kState, Status::kStateInvalid, Rung::kNominal, Rung::kStop);
  assert_int_equal(last_event(b).joint, 3);
}

// Proves EXE-9.

void late_cycles_that_are_bridged_one_by_one_have_a_rate(void**) {
  Bench& b = started();
  int cycles = 0;
  while (b.cycle(6.0) == Status::kOk) ++cycles;  // five missed: bridged
  assert_int_equal(cycles, 10);
  assert_event(b, Cause::kSlip, Status::kSlip, Rung::kNominal, Rung::kHold);
  Bench& seldom = started();
  for (int k = 0; k < 5000; ++k) ASSERT_OK(seldom.cycle(k % 10 == 0 ? 2.0 : 1.0));
}

// Proves LAD-8.

void the_log_keeps_the_incident_over_a_start_and_its_later_causes(void**) {
  Bench& b = started();
  FollowingArm arm = moving(b);
  b.hal.state.dq[5] = 2.0;  // the law's torque is not finite: the guard brakes
  ASSERT_STATUS(arm.cycle(), Status::kCommandNotFinite);
  const std::uint32_t events = b.executive.events().count();
  ASSERT_STATUS(b.cycle(50.0), Status::kCommandNotFinite);
  assert_event(b, Cause::kLongSlip, Status::kSlip, Rung::kStop, Rung::kStop);
  ASSERT_STATUS(b.cycle(50.0), Status::kCommandNotFinite);
  assert_int_equal(b.executive.events().count(), events + 1);  // once on a rung
  ASSERT_OK(b.executive.start());
  Event event;
  assert_true(b.executive.events().read(events - 1, event) && event.cause == Cause::kStage);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_exchange_goes_on_while_drives_are_disabled_armed_and_enabled),
      cmocka_unit_test(drives_that_are_not_armed_in_time_are_given_up),
      cmocka_unit_test(drives_that_are_not_disabled_in_time_are_in_the_log),
      cmocka_unit_test(a_joint_that_cannot_be_armed_is_named_with_its_drives_code),
      cmocka_unit_test(faults_from_before_an_arming_are_told_once_for_every_joint_that_had_one),
      cmocka_unit_test(a_warning_stops_nothing_and_is_told_once_in_an_arming),
      cmocka_unit_test(a_drive_that_leaves_enabled_disables_all_in_every_mode),
      cmocka_unit_test(after_a_wire_that_failed_arming_is_refused_until_it_works),
      cmocka_unit_test(drives_that_had_a_cycle_to_arm_are_waited_for),
      cmocka_unit_test(before_a_start_nothing_is_exchanged),
      cmocka_unit_test(a_start_on_a_higher_rung_is_a_stop_in_the_log),
      cmocka_unit_test(a_request_to_disabled_drives_is_refused_at_once),
      cmocka_unit_test(a_state_that_does_not_change_is_bridged_for_five_periods_and_no_longer),
      cmocka_unit_test(a_joint_that_is_not_measured_is_named),
      cmocka_unit_test(late_cycles_that_are_bridged_one_by_one_have_a_rate),
      cmocka_unit_test(the_log_keeps_the_incident_over_a_start_and_its_later_causes),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
