// Faults while the drives are armed and while they follow: every row of the table, for the first, a
// middle and the last joint, in every phase, on three layouts of the buses.
#include "tests/drives/fault_rows.hpp"

namespace tactus::can {
namespace {

struct Outcome {
  Status status = Status::kOk;
  int joint = -1;    ///< named by the event
  int reaction = 0;  ///< cycles until the stop is sent; 0: none
  int off = 0;       ///< cycles from there until no drive has power
  Status arms = Status::kOk, starts = Status::kOk;
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
  Event event;
  for (std::uint32_t i = 0; bench.executive.events().read(i, event); ++i)
    if (event.to == Rung::kDisabled && event.from != Rung::kDisabled) outcome.joint = event.joint;
}

/// The cause goes; the arm is to be taken over where it is.
void rearm(MasterBench& bench, SafetyWatch& watch, Outcome& outcome) {
  heal(bench);
  for (int i = 0; i < 200; ++i) (void)watch.cycle();
  assert_false(bench.executive.busy());  // a drive that is lost is not waited for
  const JointVector before = bench.hal.arm.arm().q();
  outcome.arms = bench.arm();
  if (outcome.arms != Status::kOk) outcome.starts = bench.start();
  ASSERT_OK(outcome.starts);
  for (int i = 0; i < 200; ++i) ASSERT_OK(watch.cycle());
  outcome.moved = (bench.hal.arm.arm().q() - before).cwiseAbs().maxCoeff();
}

Outcome suffer(Buses buses, const FaultRow& row, When when, int joint) {
  MasterBench& bench = fresh_bench(buses);
  lead_to(bench, when);
  SafetyWatch watch(bench);
  Outcome outcome;
  row.begin(bench, joint);
  const Disturbance& wire = bench.hal.disturbance;
  const int named = wire.to_drive ? (wire.id & 0xF) - 1 : joint;
  await_stop(bench, watch, outcome);
  if (outcome.reaction == 0) {
    ASSERT_OK(outcome.status);
    return outcome;
  }
  ASSERT_STATUS(outcome.status, row.status);
  assert_int_equal(outcome.joint, row.status == Status::kBusConflict ? -1 : named);
  rearm(bench, watch, outcome);
  return outcome;
}

void judge(const FaultRow& row, When when, const Outcome& outcome) {
  const int most = row.most[static_cast<std::size_t>(when)];
  assert_int_equal(outcome.reaction > 0, most > 0);
  assert_in_range(outcome.reaction, 0, most);
  if (most == 0) return;
  assert_in_range(outcome.off, 0, row.off);
  ASSERT_STATUS(outcome.arms, row.arms);
  ASSERT_NEAR(outcome.moved, 0.0, 1e-3);
}

void explain(const FaultRow& row, When when, const Outcome& worst) {
  const bool none = worst.reaction == 0;
  const bool arms = row.arms == Status::kOk;
  print_message("| %s | %s | %s | %d | %d | %s |\n", row.fault,
                kWhenNames[static_cast<std::size_t>(when)], none ? "none" : name(worst.status),
                worst.reaction, worst.off,
                none   ? "follows"
                : arms ? "arm()"
                       : "start()");
}

void every_fault_stops_all_drives_or_is_bridged(Buses buses) {
  for (const FaultRow& row : kFaultRows)
    for (const When when : {When::kSwitchingOn, When::kReleasing, When::kFollowing}) {
      Outcome worst;
      for (const int joint : {0, 3, 6}) {
        const Outcome outcome = suffer(buses, row, when, joint);
        if (outcome.reaction > worst.reaction) worst.reaction = outcome.reaction;
        if (outcome.off > worst.off) worst.off = outcome.off;
        worst.status = outcome.status;
        judge(row, when, outcome);
      }
      explain(row, when, worst);
    }
}

// Proves CAN-11.
void every_fault_on_can_fd_stops_all_drives_or_is_bridged(void**) {
  every_fault_stops_all_drives_or_is_bridged(Buses::kFdPacked);
}
void every_fault_on_three_classic_buses_stops_all_drives_or_is_bridged(void**) {
  every_fault_stops_all_drives_or_is_bridged(Buses::kClassicPlain);
}
void every_fault_on_two_classic_buses_stops_all_drives_or_is_bridged(void**) {
  every_fault_stops_all_drives_or_is_bridged(Buses::kClassicPacked);
}

}  // namespace
}  // namespace tactus::can

int main() {
  using namespace tactus::can;
  const CMUnitTest tests[] = {
      cmocka_unit_test(every_fault_on_can_fd_stops_all_drives_or_is_bridged),
      cmocka_unit_test(every_fault_on_three_classic_buses_stops_all_drives_or_is_bridged),
      cmocka_unit_test(every_fault_on_two_classic_buses_stops_all_drives_or_is_bridged),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
