// Homing in arming, over any wire: two drives count from power-on, one is homed where it is and one
// at its limit switch. What must hold in every cycle is judged by what the frames command and what
// the drives do by their own account; an event may come in any cycle.
//
// A bench has in addition axis(bench, joint), word_sent(bench, joint) and inject(bench, joint,
// kind, value), a fault of a drive.
#pragma once

#include "sim_plant/drives/axis.hpp"
#include "sim_plant/drives/faults.hpp"
#include "tests/hal/cia402/safety_watch.hpp"

namespace tactus::cia402 {

inline constexpr int kHere = 1, kAtSwitch = 3;  // joints, from 0
inline constexpr double kSwitch_rad = 0.01;     // from where the arm stands

/// Sets the two joints up; the others know their positions.
template <class Bench>
void count_from_power_on(Bench& bench) {
  const auto& ready = robot_mjcf().ready_pose;
  for (drives::HomingSettings& homing : bench.plant.homing) homing.shows = true;
  for (const int j : {kHere, kAtSwitch}) bench.plant.homing[j].incremental = true;
  bench.plant.homing[kAtSwitch].upper_rad = ready[kAtSwitch] + kSwitch_rad;
  bench.plant.brake_release_s = 0.030;
  bench.drive.brake_ms = 40;
  bench.drive.step_ms = 300;
  bench.drive.referenced_bit = 14;
  bench.drive.homing_method[kHere] = 37;
  bench.drive.homing_method[kAtSwitch] = 18;
  bench.drive.homing_ms = 1500;
  bench.drive.position_offset[kHere] = ready[kHere];
  // Before it is homed this joint counts 0, which is outside of its range.
  bench.plant.homing[kAtSwitch].offset = static_cast<std::int32_t>(
      (ready[kAtSwitch] + kSwitch_rad) * bench.drive.increments[kAtSwitch] / 6.283185307179586);
}

template <class Bench>
class HomingWatch {
 public:
  explicit HomingWatch(Bench& bench) : bench_(bench), watch_(bench) {}

  Status cycle() {
    const Status status = watch_.cycle();
    const bool known = axis(bench_, kHere).referenced() && axis(bench_, kAtSwitch).referenced();
    int enabled = 0, powered = 0;
    for (int j = 0; j < kDof; ++j) {
      const std::uint16_t word = word_sent(bench_, j);
      enabled += (word & 0x0008) != 0 ? 1 : 0;
      powered += axis(bench_, j).powered() ? 1 : 0;
      // Bit 4 is for a drive that is not homed yet, in the cycle after which it moves by itself.
      if ((word & 0x0010) != 0) assert_true(j == kHere || j == kAtSwitch);
      starts_ += (word & 0x0010) != 0 && (before_[static_cast<std::size_t>(j)] & 0x0010) == 0;
      before_[static_cast<std::size_t>(j)] = word;
    }
    // A drive may lose its reference by a fault while all of them are enabled, or in the cycles in
    // which its feedback is bridged.
    constexpr int kBridged = 4;
    unknown_ = known ? 0 : unknown_ + 1;
    all_may_ = unknown_ <= kBridged || (all_may_ && (enabled > 0 || powered > 0));
    if (!all_may_) {
      assert_true(enabled <= 1 && powered <= 1);
      assert_false(pushes(bench_));
    }
    return status;
  }
  /// Rising edges of bit 4 until now.
  int starts() const { return starts_; }

 private:
  Bench& bench_;
  SafetyWatch<Bench> watch_;
  std::array<std::uint16_t, kDof> before_{};
  int starts_ = 0;
  int unknown_ = 1000;    // cycles since every drive knew its position
  bool all_may_ = false;  // be enabled: every drive knows its position, or did
};

/// Arms; returns the cycles that it took, and the status.
template <class Bench>
int arm_watched(Bench& bench, HomingWatch<Bench>& watch, Status& status) {
  int count = 0;
  status = bench.executive.arm();
  for (; status == Status::kArming && count < 12000; ++count) {
    status = watch.cycle();
    if (status == Status::kArming) status = bench.executive.arm();
  }
  return count;
}

/// The arm is where its drives say, and nothing pushes it.
template <class Bench>
void expect_homed(Bench& bench, HomingWatch<Bench>& watch) {
  const JointVector before = bench.plant_q();
  for (int i = 0; i < 50; ++i) ASSERT_OK(watch.cycle());
  assert_true((bench.pipeline.robot.q.value - bench.plant_q()).cwiseAbs().maxCoeff() < 1e-3);
  assert_true((bench.plant_q() - before).cwiseAbs().maxCoeff() < 1e-3);
}

template <class Bench>
void home_and_arm_again(Bench& bench) {
  count_from_power_on(bench);
  ASSERT_OK(bench.load());
  ASSERT_OK(bench.connect());
  assert_string_equal(bench.hal.master.to_home().c_str(),
                      "joint 2 (method 37), joint 4 (method 18)");
  HomingWatch<Bench> watch(bench);
  Status status = Status::kOk;
  const int took = arm_watched(bench, watch, status);
  if (status != Status::kOk) print_error("%s\n", bench.hal.trouble().c_str());
  ASSERT_OK(status);
  assert_int_equal(watch.starts(), 2);
  expect_homed(bench, watch);
  assert_true(bench.hal.master.to_home().empty());
  bench.executive.halt();
  (void)watch.cycle();
  bench.settle();
  const int again = arm_watched(bench, watch, status);
  ASSERT_OK(status);
  assert_int_equal(watch.starts(), 2);
  expect_homed(bench, watch);
  print_message("arming with two homings takes %d cycles, without %d\n", took, again);
}

/// What comes in the midst of an arming.
template <class Bench>
struct HomingEvent {
  const char* name;
  void (*begin)(Bench& bench);
  Status status;    ///< that the executive latches
  int most;         ///< cycles until no frame enables a drive
  bool may_not_be;  ///< an event that has no effect outside of some steps
  bool connects;    ///< only connecting leads back, or may have to
};

template <class Bench>
void request_stop(Bench& bench) {
  bench.executive.halt();
}
template <class Bench, drives::FaultKind kind, std::uint32_t value, int joint>
void drive_fault(Bench& bench) {
  inject(bench, joint, kind, value);
}
/// What the arm and its drives do, over any wire.
// clang-format off
template <class Bench>
inline constexpr HomingEvent<Bench> kOfDrives[] = {
    {"stop requested", request_stop<Bench>, Status::kHalted, 1, false, false},
    {"EMCY and fault of the drive that is homed", drive_fault<Bench, drives::FaultKind::kEmergency, 0x7121, kAtSwitch>, Status::kDriveFault, 4, true, false},
    {"EMCY and fault of another drive", drive_fault<Bench, drives::FaultKind::kEmergency, 0x7121, 6>, Status::kDriveFault, 4, true, false},
    {"switch on disabled by itself", drive_fault<Bench, drives::FaultKind::kSwitchOnDisabled, 0, kAtSwitch>, Status::kDriveFault, 4, true, false},
    {"reboot of the drive that is homed", drive_fault<Bench, drives::FaultKind::kReboot, 0, kAtSwitch>, Status::kBusTimeout, 6, false, true},
    {"no answers by SDO", drive_fault<Bench, drives::FaultKind::kSdoSilence, 0, kAtSwitch>, Status::kBusTimeout, 1500, true, false},
    {"6060h is refused", drive_fault<Bench, drives::FaultKind::kSdoAbort, 0x6060, kAtSwitch>, Status::kRefusedByRobot, 1500, true, false},
    {"6098h is refused", drive_fault<Bench, drives::FaultKind::kSdoAbort, 0x6098, kAtSwitch>, Status::kRefusedByRobot, 1500, true, false},
    {"6061h shows another mode", drive_fault<Bench, drives::FaultKind::kWrongMode, 9, kAtSwitch>, Status::kDriveFault, 1500, true, false},
    {"homing ends in an error", drive_fault<Bench, drives::FaultKind::kHomingFails, 2, kAtSwitch>, Status::kNotReferenced, 1500, true, false},
    {"homing ends in an error while it moves", drive_fault<Bench, drives::FaultKind::kHomingFails, 3, kHere>, Status::kNotReferenced, 1500, true, false},
    {"homing does not end", drive_fault<Bench, drives::FaultKind::kHomingFails, 1, kAtSwitch>, Status::kNotReferenced, 3000, true, false},
};
// clang-format on

template <class Bench>
void suffer(const HomingEvent<Bench>& event, Bench& bench, int at, int& reaction, int& off) {
  constexpr int kMostOff = 150;  // cycles: the quick stop of an emulated drive until it stands
  count_from_power_on(bench);
  ASSERT_OK(bench.load());
  ASSERT_OK(bench.connect());
  HomingWatch<Bench> watch(bench);
  Status status = bench.executive.arm();
  int since = 0, unpowered = 0;
  for (int i = 0; i < 12000 && status == Status::kArming; ++i) {
    if (i == at) event.begin(bench);
    if (i >= at) ++since;
    status = watch.cycle();
    if (status == Status::kArming) status = bench.executive.arm();
  }
  if (status == Status::kOk) {
    assert_true(event.may_not_be);
    return;
  }
  if (status != event.status)
    print_error("%s at %d: %s\n", event.name, at, bench.hal.trouble().c_str());
  ASSERT_STATUS(status, event.status);
  assert_in_range(since, 0, event.most);
  assert_false(enables(bench));
  while (powered(bench) && unpowered < kMostOff) {
    ++unpowered;
    (void)watch.cycle();
  }
  if (powered(bench)) print_error("%s at %d: power after %d cycles\n", event.name, at, unpowered);
  assert_false(powered(bench));
  reaction = std::max(reaction, since);
  off = std::max(off, unpowered);
  for (int i = 0; i < 20; ++i) (void)watch.cycle();
  heal(bench);
  for (int i = 0; i < 300; ++i) (void)watch.cycle();
  (void)arm_watched(bench, watch, status);
  if (status != Status::kOk && event.connects) {
    ASSERT_OK(bench.connect());
    (void)arm_watched(bench, watch, status);
  }
  if (status != Status::kOk)
    print_error("%s at %d, again: %s\n", event.name, at, bench.hal.trouble().c_str());
  ASSERT_OK(status);
  expect_homed(bench, watch);
}

/// Every event in every cycle of an arming that homes, or every `apart`-th: those of the drives and
/// those of the wire.
template <class Bench, std::size_t count>
void suffer_everything(const HomingEvent<Bench> (&of_wire)[count], Bench& (*fresh)(), int last,
                       int apart) {
  const auto suffer_it = [&](const HomingEvent<Bench>& event) {
    int reaction = 0, off = 0;
    for (int at = 1; at < last; at += apart) suffer(event, fresh(), at, reaction, off);
    print_message("| %s | %s | %d | %d |\n", event.name, name(event.status), reaction, off);
  };
  for (const HomingEvent<Bench>& event : kOfDrives<Bench>) suffer_it(event);
  for (const HomingEvent<Bench>& event : of_wire) suffer_it(event);
}

}  // namespace tactus::cia402
