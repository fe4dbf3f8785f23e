// Faults while the drives are armed and while they follow: every row of the table of
// docs/fer-ethercat.md, for the first, a middle and the last joint, in every phase.
#include "tests/ethercat/fault_bench.hpp"

namespace tactus::ethercat {
namespace {

enum class When : std::uint8_t { kSwitchingOn, kReleasing, kFollowing };
constexpr const char* kWhenNames[] = {"switching on", "brakes opening", "following"};

struct FaultRow {
  const char* fault;
  void (*begin)(MasterBench& bench, int joint);
  Status status;                 ///< that the executive latches
  std::array<int, 3> most;       ///< by When: cycles until the stop is sent; 0: nothing happens
  int off;                       ///< most cycles from there until no drive has power
  Status arms;                   ///< of the next arm(); if it refuses, only start() leads back
  Status instead = Status::kOk;  ///< of `status`, if it is seen first; kOk: nothing else
};

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

constexpr std::array<int, 3> kNever = {0, 0, 0};
constexpr Status kTimeout = Status::kBusTimeout, kFault = Status::kDriveFault,
                 kLost = Status::kConnectionLost;

// The cycles: 4 without inputs are one more than max_missed; the watchdog of the outputs is 10 ms;
// the states of all slaves are read within 7 cycles; a brake is watched for 500 ms.
// clang-format off
constexpr FaultRow kRows[] = {
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
    {"measured torque saturated", drive<FaultKind::kSaturatedTorque>, Status::kStateInvalid, {230, 210, 3}, 3, Status::kOk},
    {"6061h shows another mode", drive<FaultKind::kWrongMode, 9>, kFault, {60, 60, 0}, 3, Status::kOk},
};
// clang-format on

struct Outcome {
  Status status = Status::kOk;
  int reaction = 0;  ///< cycles until the stop is sent; 0: none
  int off = 0;       ///< cycles from there until no drive has power
  Status arms = Status::kOk;
  double moved = 0.0;  ///< by the rearm, rad
};

/// Takes the drives to where the fault is to begin.
void lead_to(MasterBench& bench, When when) {
  ASSERT_OK(bench.load());
  ASSERT_OK(bench.executive.start());
  bench.now_ns = -bench.hal.period_ns;
  if (when == When::kFollowing) {
    ASSERT_OK(bench.arm());
    return ASSERT_OK(bench.cycles(50));
  }
  ASSERT_STATUS(bench.executive.arm(), Status::kArming);
  (void)bench.cycle();
  if (when == When::kSwitchingOn) return;
  for (int i = 0; i < 100 && bench.hal.master.phase() != cia402::Phase::kReleasing; ++i)
    (void)bench.cycle();
  assert_true(bench.hal.master.phase() == cia402::Phase::kReleasing);
}

/// Runs until the master stops the drives, or long enough to say that it does not.
void await_stop(MasterBench& bench, SafetyWatch& watch, Outcome& outcome) {
  for (int i = 1; i <= 700 && outcome.reaction == 0; ++i) {
    if (bench.executive.rung() == Rung::kArming) (void)bench.executive.arm();
    outcome.status = watch.cycle();
    const bool stops = bench.hal.master.phase() == cia402::Phase::kFailed;
    if (stops || bench.executive.rung() == Rung::kDisabled) outcome.reaction = i;
  }
  if (outcome.reaction == 0) return;
  assert_false(enables(bench));
  assert_false(pushes(bench));
  do {
    if (powered(bench)) ++outcome.off;
    outcome.status = watch.cycle();
  } while (powered(bench) && outcome.off < 3000);
}

/// The cause lasts for longer than the drives wait, then goes; the arm is to be taken over where it
/// is.
void rearm(MasterBench& bench, SafetyWatch& watch, Outcome& outcome) {
  for (int i = 0; i < 20; ++i) (void)watch.cycle();
  heal(bench);
  for (int i = 0; i < 300; ++i) (void)watch.cycle();
  const JointVector before = bench.hal.line.arm().arm().q();
  outcome.arms = bench.arm();
  if (outcome.arms != Status::kOk) {
    const Status starts = bench.start();
    if (starts != Status::kOk) print_error("%s\n", bench.hal.trouble().c_str());
    ASSERT_OK(starts);
  }
  for (int i = 0; i < 200; ++i) ASSERT_OK(watch.cycle());
  outcome.moved = (bench.hal.line.arm().arm().q() - before).cwiseAbs().maxCoeff();
}

Outcome suffer(const FaultRow& row, When when, int joint) {
  MasterBench& bench = fresh_bench();
  lead_to(bench, when);
  SafetyWatch watch(bench);
  Outcome outcome;
  row.begin(bench, joint);
  await_stop(bench, watch, outcome);
  if (outcome.reaction == 0) {
    ASSERT_OK(outcome.status);
    return outcome;
  }
  rearm(bench, watch, outcome);
  return outcome;
}

void judge(const FaultRow& row, When when, const Outcome& outcome) {
  const int most = row.most[static_cast<std::size_t>(when)];
  assert_int_equal(outcome.reaction > 0, most > 0);
  assert_in_range(outcome.reaction, 0, most);
  if (most == 0) return;
  const bool other = row.instead != Status::kOk && outcome.status == row.instead;
  ASSERT_STATUS(outcome.status, other ? row.instead : row.status);
  assert_in_range(outcome.off, 0, row.off);
  ASSERT_STATUS(outcome.arms, row.arms);
  ASSERT_NEAR(outcome.moved, 0.0, 1e-3);
}

// Proves ECAT-6.
void every_fault_stops_all_drives_or_is_bridged(void**) {
  for (const FaultRow& row : kRows)
    for (const When when : {When::kSwitchingOn, When::kReleasing, When::kFollowing}) {
      Outcome worst;
      for (const int joint : {0, 3, 6}) {
        const Outcome outcome = suffer(row, when, joint);
        if (outcome.reaction > worst.reaction) worst.reaction = outcome.reaction;
        if (outcome.off > worst.off) worst.off = outcome.off;
        worst.status = outcome.status;
        worst.arms = outcome.arms;
        print_message("%s, %s, joint %d: %s after %d, off %d, rearm %s, moved %.1e\n", row.fault,
                      kWhenNames[static_cast<std::size_t>(when)], joint + 1, name(outcome.status),
                      outcome.reaction, outcome.off, name(outcome.arms), outcome.moved);
        judge(row, when, outcome);
      }
    }
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

void a_slave_that_fell_is_named_with_its_code(void**) {
  MasterBench& bench = fresh_bench();
  ASSERT_OK(bench.load());
  ASSERT_OK(bench.start());
  bench.add(LineFaultKind::kFall, 5, 0, kForGood, 0x002C);
  for (int i = 0; i < 30; ++i) (void)bench.cycle();
  const Message said = bench.hal.trouble();
  print_message("%s\n", said.c_str());
  assert_non_null(std::strstr(said.c_str(), "slave 5 is in SAFEOP"));
  assert_non_null(std::strstr(said.c_str(), "fatal synchronization error (002Ch)"));
}

}  // namespace
}  // namespace tactus::ethercat

int main() {
  using namespace tactus::ethercat;
  const CMUnitTest tests[] = {
      cmocka_unit_test(every_fault_stops_all_drives_or_is_bridged),
      cmocka_unit_test(inputs_are_not_taken_with_a_wrong_working_counter),
      cmocka_unit_test(lost_and_late_frames_are_counted),
      cmocka_unit_test(a_slave_that_fell_is_named_with_its_code),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
