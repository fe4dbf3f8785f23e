// Faults while the drives are armed and while they follow: every row of the table of
// docs/robots/fer-ethercat.md, for the first, a middle and the last joint, in every phase.
#include "tests/hal/cia402/fault_table.hpp"
#include "tests/hal/ethercat/fault_bench.hpp"

namespace tactus::ethercat {
namespace {

using cia402::kFault, cia402::kNever, cia402::kTimeout;

template <LineFaultKind kind, int cycles, int value = 0>
void line(MasterBench& bench, int joint) {
  const bool behind = kind == LineFaultKind::kBreak && joint > 0;  // of the slave before
  bench.add(kind, behind ? joint : joint + 1, 0, cycles, value);
}
void all_open(MasterBench& bench, int) {
  bench.add(LineFaultKind::kBreak, 0, 0, kForGood);
}
template <FaultKind kind, std::uint32_t value = 0>
void drive(MasterBench& bench, int joint) {
  bench.add(kind, joint + 1, value);
}

constexpr Status kLost = Status::kConnectionLost;

// The cycles: 4 without inputs are one more than max_missed; the watchdog of the outputs is 10 ms;
// the states of all slaves are read within 7 cycles; a brake is watched for 500 ms.
// clang-format off
constexpr cia402::FaultRow<MasterBench> kRows[] = {
    {"frame lost in 1 cycle", line<LineFaultKind::kLose, 1>, Status::kOk, kNever, 0, Status::kOk},
    {"frame lost in 3 cycles", line<LineFaultKind::kLose, 3>, Status::kOk, kNever, 0, Status::kOk},
    {"frames lost", line<LineFaultKind::kLose, kForGood>, kTimeout, {6, 6, 6}, 14, Status::kOk},
    {"frame one cycle late, once", line<LineFaultKind::kDelay, 1>, Status::kOk, kNever, 0, Status::kOk},
    {"frames one cycle late", line<LineFaultKind::kDelay, kForGood>, kTimeout, {6, 6, 6}, 14, Status::kOk},
    {"working counter wrong in 3 cycles", line<LineFaultKind::kCounter, 3, 1>, Status::kOk, kNever, 0, Status::kOk},
    {"working counter wrong", line<LineFaultKind::kCounter, kForGood, 0xFFFF>, kTimeout, {6, 6, 6}, 14, Status::kOk},
    {"cable open in 1 cycle", line<LineFaultKind::kBreak, 1>, Status::kOk, kNever, 0, Status::kOk},
    {"cable open", line<LineFaultKind::kBreak, kForGood>, kTimeout, {6, 6, 6}, 14, kLost},
    {"cable to the first slave open", all_open, kTimeout, {6, 6, 6}, 14, kLost},
    {"falls to SAFEOP", line<LineFaultKind::kFall, kForGood, 0x001A>, kFault, {12, 12, 12}, 14, kLost, kLost},
    {"EMCY and fault", drive<FaultKind::kEmergency, 0x4310>, kFault, {3, 3, 3}, 3, Status::kOk},
    {"switch on disabled by itself", drive<FaultKind::kSwitchOnDisabled>, kFault, {0, 3, 3}, 3, Status::kOk},
    {"brake does not open", drive<FaultKind::kBrakeStuck>, kFault, {512, 505, 0}, 3, Status::kOk},
    {"restart", drive<FaultKind::kReboot>, kTimeout, {6, 6, 6}, 14, Status::kNotAtRest},
    {"measured torque saturated", drive<FaultKind::kSaturatedTorque>, Status::kStateInvalid, {330, 310, 3}, 3, Status::kOk},
    {"6061h shows another mode", drive<FaultKind::kWrongMode, 9>, kFault, {60, 60, 0}, 3, Status::kOk},
    {"statusword bit 7, warning", drive<FaultKind::kWarning, 0x4210>, Status::kOk, kNever, 0, Status::kOk},
};
// clang-format on

/// The cause lasts for longer than the drives wait.
cia402::Outcome suffer(const cia402::FaultRow<MasterBench>& row, cia402::When when, int joint) {
  MasterBench& bench = fresh_bench();
  lead_to(bench, when);
  SafetyWatch watch(bench);
  cia402::Outcome outcome;
  row.begin(bench, joint);
  await_stop(bench, watch, outcome);
  if (outcome.reaction == 0) return outcome;
  for (int i = 0; i < 20; ++i) (void)watch.cycle();
  heal(bench);
  for (int i = 0; i < 300; ++i) (void)watch.cycle();
  rearm(bench, watch, outcome);
  return outcome;
}

// Proves ECAT-6.
void every_fault_stops_all_drives_or_is_bridged(void**) {
  cia402::judge_faults(std::begin(kRows), std::end(kRows), suffer);
}

/// A slave that is missing leaves the bytes that were sent: they must not pass for inputs.
void inputs_are_not_taken_with_a_wrong_working_counter(void**) {
  MasterBench& bench = fresh_bench();
  ASSERT_OK(bench.load());
  ASSERT_OK(bench.start());
  ASSERT_OK(bench.cycles(20));
  const JointVector before = bench.pipeline.robot.q.value;
  bench.add(LineFaultKind::kBreak, 2, 0, 3);
  for (int i = 0; i < 3; ++i) {
    ASSERT_OK(bench.cycle());
    assert_true((bench.pipeline.robot.q.value - before).cwiseAbs().maxCoeff() < 1e-3);
  }
  ASSERT_OK(bench.cycles(20));
  const LineCounts& counts = bench.hal.master.counts();
  assert_int_equal(counts.counter, 3);
  assert_int_equal(counts.lost, 0);
}

void lost_and_late_frames_are_counted(void**) {
  MasterBench& bench = fresh_bench();
  ASSERT_OK(bench.load());
  ASSERT_OK(bench.start());
  bench.add(LineFaultKind::kLose, 0, 10, 2);
  bench.add(LineFaultKind::kDelay, 0, 2000, 1);
  ASSERT_OK(bench.cycles(2100));
  const LineCounts& counts = bench.hal.master.counts();
  assert_int_equal(counts.lost, 3);
  assert_int_equal(counts.late, 1);
  assert_int_equal(counts.counter, 0);
}

// Proves ECAT-16.
void faults_that_stood_before_are_told_with_their_codes_and_cleared(void**) {
  MasterBench& bench = fresh_bench();
  ASSERT_OK(bench.load());
  bench.add(FaultKind::kEmergency, 7, 0x7500);
  bench.add(FaultKind::kWarning, 2, 0x4210);
  const Status status = bench.start();
  if (status != Status::kOk) print_error("%s\n", bench.hal.trouble().c_str());
  ASSERT_OK(status);
  ASSERT_OK(bench.cycles(100));
  const cia402::Detail fault = detail_of(bench, Cause::kOldFault);
  assert_string_equal(fault.joints.c_str(), "7");
  assert_int_equal(fault.code, 0x7500);
  const cia402::Detail warning = detail_of(bench, Cause::kWarning);
  assert_string_equal(warning.joints.c_str(), "2");
  assert_int_equal(warning.code, 0x4210);
}

// Proves ECAT-15.
/// By then the clock of the cycles must not wait for frames: drives are given up by the clock.
void a_wire_that_does_not_answer_is_known_after_max_missed_frames(void**) {
  MasterBench& bench = fresh_bench();
  ASSERT_OK(bench.load());
  ASSERT_OK(bench.start());
  ASSERT_OK(bench.cycles(20));
  bench.add(LineFaultKind::kBreak, 0, 0, 10);
  for (int i = 0; i < bench.drive.max_missed; ++i) (void)bench.cycle();
  assert_true(bench.hal.master.answers());
  for (int i = 0; i < 3; ++i) (void)bench.cycle();
  assert_false(bench.hal.master.answers());
  for (int i = 0; i < 20; ++i) (void)bench.cycle();
  assert_true(bench.hal.master.answers());
}

/// Where drives are to be disabled nothing is gained by waiting longer.
void a_stop_waits_for_two_frames_at_most(void**) {
  MasterBench& bench = fresh_bench();
  bench.drive.max_missed = 100;
  ASSERT_OK(bench.load());
  ASSERT_OK(bench.start());
  ASSERT_OK(bench.cycles(20));
  bench.add(LineFaultKind::kBreak, 0, 0, kForGood);
  for (int i = 0; i < 20; ++i) (void)bench.cycle();  // [guard] max_age is over
  assert_true(bench.hal.master.slave(0).feedback.lost == Status::kOk);
  assert_false(bench.hal.master.answers());
  const Message said = bench.hal.trouble();
  print_message("%s\n", said.c_str());
  assert_non_null(std::strstr(said.c_str(), "no frame came back in the last"));
}

/// A reply that comes twice is used once.
void copies_of_frames_are_strange(void**) {
  MasterBench& bench = fresh_bench();
  ASSERT_OK(bench.load());
  ASSERT_OK(bench.start());
  int copies = 3;
  bench.hal.tamper = [&](Frame& frame) {
    if (copies-- > 0) bench.hal.master.receive(frame);
  };
  ASSERT_OK(bench.cycles(10));
  const LineCounts& counts = bench.hal.master.counts();
  assert_int_equal(counts.strange, 3);
  assert_int_equal(counts.late, 0);
  assert_int_equal(counts.lost, 0);
}

void a_slave_that_fell_is_named_with_its_code(void**) {
  MasterBench& bench = fresh_bench();
  ASSERT_OK(bench.load());
  ASSERT_OK(bench.start());
  bench.add(LineFaultKind::kFall, 5, 0, kForGood, 0x002C);
  for (int i = 0; i < 30; ++i) (void)bench.cycle();
  const Message said = bench.hal.trouble();
  print_message("%s\n", said.c_str());
  assert_non_null(std::strstr(said.c_str(), "joint 5 (slave 5) is in SAFEOP"));
  assert_non_null(std::strstr(said.c_str(), "fatal synchronization error (002Ch)"));
}

// Proves CAN-3.
void drives_that_fall_back_are_armed_all_or_named(void**) {
  cia402::arm_drives_that_fall<MasterBench>(fresh_bench,
                                            [](MasterBench& bench, int joint, double p) {
                                              drives::Fault fault;
                                              fault.node = joint + 1;
                                              fault.kind = FaultKind::kSwitchOnDisabled;
                                              fault.probability = p;
                                              assert_true(bench.hal.line.add(fault));
                                            });
}

}  // namespace
}  // namespace tactus::ethercat

int main() {
  using namespace tactus::ethercat;
  const CMUnitTest tests[] = {
      cmocka_unit_test(every_fault_stops_all_drives_or_is_bridged),
      cmocka_unit_test(inputs_are_not_taken_with_a_wrong_working_counter),
      cmocka_unit_test(lost_and_late_frames_are_counted),
      cmocka_unit_test(faults_that_stood_before_are_told_with_their_codes_and_cleared),
      cmocka_unit_test(a_wire_that_does_not_answer_is_known_after_max_missed_frames),
      cmocka_unit_test(a_stop_waits_for_two_frames_at_most),
      cmocka_unit_test(copies_of_frames_are_strange),
      cmocka_unit_test(a_slave_that_fell_is_named_with_its_code),
      cmocka_unit_test(drives_that_fall_back_are_armed_all_or_named),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
