// A fault while drives are armed or follow, over any wire: how it begins, what the master is
// expected to make of it, and the way from there to the rearm.
#pragma once

#include <string>

#include "hal/cia402/drives.hpp"
#include "tests/hal/cia402/safety_watch.hpp"
#include "tests/support/random.hpp"

namespace tactus::cia402 {

enum class When : std::uint8_t { kSwitchingOn, kReleasing, kFollowing };
inline constexpr When kWhens[] = {When::kSwitchingOn, When::kReleasing, When::kFollowing};
inline constexpr const char* kWhenNames[] = {"switching on", "brakes opening", "following"};

template <class Bench>
struct FaultRow {
  const char* fault;
  void (*begin)(Bench& bench, int joint);
  Status status;                 ///< that the executive latches
  std::array<int, 3> most;       ///< by When: cycles until the stop is sent; 0: nothing happens
  int off;                       ///< most cycles from there until no drive has power
  Status arms;                   ///< of the next arm(); if it refuses, only start() leads back
  Status instead = Status::kOk;  ///< of `status`, if it is seen first; kOk: nothing else
};

inline constexpr std::array<int, 3> kNever = {0, 0, 0};
inline constexpr Status kTimeout = Status::kBusTimeout, kFault = Status::kDriveFault;

struct Outcome {
  Status status = Status::kOk;
  int joint = -1;    ///< named by the event
  int reaction = 0;  ///< cycles until the stop is sent; 0: none
  int off = 0;       ///< cycles from there until no drive has power
  Status arms = Status::kOk;
  double moved = 0.0;  ///< by the rearm, rad
};

/// Takes the drives to where the fault is to begin.
template <class Bench>
void lead_to(Bench& bench, When when) {
  ASSERT_OK(bench.load());
  ASSERT_OK(bench.connect());
  if (when == When::kFollowing) {
    ASSERT_OK(bench.arm());
    return ASSERT_OK(bench.cycles(50));
  }
  ASSERT_STATUS(bench.executive.arm(), Status::kArming);
  (void)bench.cycle();
  if (when == When::kSwitchingOn) return;
  for (int i = 0; i < 100 && bench.hal.master.phase() != ArmingPhase::kReleasing; ++i)
    (void)bench.cycle();
  assert_true(bench.hal.master.phase() == ArmingPhase::kReleasing);
}

/// Runs until the master stops the drives, or long enough to say that it does not.
template <class Bench>
void await_stop(Bench& bench, SafetyWatch<Bench>& watch, Outcome& outcome) {
  for (int i = 1; i <= 700 && outcome.reaction == 0; ++i) {
    if (bench.executive.rung() == Rung::kArming) (void)bench.executive.arm();
    outcome.status = watch.cycle();
    const bool stops = bench.hal.master.phase() == ArmingPhase::kFailed;
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

/// The cause has gone; the arm is to be taken over where it is.
template <class Bench>
void rearm(Bench& bench, SafetyWatch<Bench>& watch, Outcome& outcome) {
  const JointVector before = bench.plant_q();
  outcome.arms = bench.arm();
  if (outcome.arms != Status::kOk) {
    const Status starts = bench.start();
    if (starts != Status::kOk) print_error("%s\n", bench.hal.trouble().c_str());
    ASSERT_OK(starts);
  }
  for (int i = 0; i < 200; ++i) ASSERT_OK(watch.cycle());
  outcome.moved = (bench.plant_q() - before).cwiseAbs().maxCoeff();
}

template <class Bench>
void judge(const FaultRow<Bench>& row, When when, const Outcome& outcome) {
  const int most = row.most[static_cast<std::size_t>(when)];
  assert_int_equal(outcome.reaction > 0, most > 0);
  assert_in_range(outcome.reaction, 0, most);
  if (most == 0) return ASSERT_OK(outcome.status);
  const bool other = row.instead != Status::kOk && outcome.status == row.instead;
  ASSERT_STATUS(outcome.status, other ? row.instead : row.status);
  assert_in_range(outcome.off, 0, row.off);
  ASSERT_STATUS(outcome.arms, row.arms);
  ASSERT_NEAR(outcome.moved, 0.0, 1e-3);
}

/// Lets a joint suffer each fault in each phase, and prints the rows of the documents' tables: the
/// largest figures of the first, a middle and the last joint.
template <class Bench>
void judge_faults(const FaultRow<Bench>* begin, const FaultRow<Bench>* end,
                  Outcome (*suffer)(const FaultRow<Bench>& row, When when, int joint)) {
  for (const FaultRow<Bench>* row = begin; row != end; ++row)
    for (const When when : kWhens) {
      Outcome worst;
      for (const int joint : {0, 3, 6}) {
        const Outcome outcome = suffer(*row, when, joint);
        judge(*row, when, outcome);
        worst.reaction = std::max(worst.reaction, outcome.reaction);
        worst.off = std::max(worst.off, outcome.off);
        worst.status = outcome.status;
        worst.arms = outcome.arms;
      }
      const bool none = worst.reaction == 0;
      print_message("| %s | %s | %s | %d | %d | %s |\n", row->fault,
                    kWhenNames[static_cast<std::size_t>(when)], none ? "none" : name(worst.status),
                    worst.reaction, worst.off,
                    none                        ? "follows"
                    : worst.arms == Status::kOk ? "arm()"
                                                : "start()");
    }
}

/// Arms while drives of random joints drop to "switch on disabled" at random: `weaken` makes one do
/// so with a probability in each period.
template <class Bench>
void arm_drives_that_fall(Bench& (*fresh)(), void (*weaken)(Bench& bench, int joint, double p)) {
  Random random{402};
  int armed = 0, refused = 0;
  for (int trial = 0; trial < 24; ++trial) {
    Bench& bench = fresh();
    ASSERT_OK(bench.load());
    ASSERT_OK(bench.connect());
    std::string weak;
    for (int j = 0; j < kDof; ++j)
      if (random.below(4) == 0) weak += static_cast<char>('1' + j);
    const double p = random.uniform(0.0, random.below(2) == 0 ? 0.002 : 0.5);
    for (const char joint : weak) weaken(bench, joint - '1', p);
    const Status status = bench.arm();
    if (status == Status::kOk) {
      ++armed;
      bool all = true;
      for (int j = 0; j < kDof; ++j) all = all && axis(bench, j).powered();
      if (!all) ASSERT_STATUS(bench.cycles(5), Status::kDriveFault);  // it has just fallen
      continue;
    }
    ++refused;
    ASSERT_STATUS(status, Status::kDriveFault);
    const std::string named = detail_of(bench, Cause::kDrive).joints;
    assert_int_equal(named.size(), 1);
    assert_true(weak.find(named) != std::string::npos);
    const std::string why = bench.hal.trouble().c_str();
    assert_true(why.rfind("joint " + named, 0) == 0);
    if (p > 0.1) print_message("%s\n", why.c_str());
  }
  print_message("%d armed, %d refused\n", armed, refused);
  assert_true(armed > 3 && refused > 3);
}

}  // namespace tactus::cia402
