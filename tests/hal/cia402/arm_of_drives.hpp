// Seven drives without a bus and without an arm: each follows the power drive state machine of the
// standard, written as its table of transitions, one step per cycle.
#pragma once

#include <cstring>

#include "hal/cia402/drives.hpp"
#include "tests/support/testing.hpp"

namespace tactus::cia402 {

struct FakeDrive {
  std::uint16_t word = 0x0250;  // switch on disabled
  bool stays = false;           // ignores every command
  bool reset_seen_low = true;
  std::uint16_t shows = 0, hides = 0;  // bits of the statusword that are not of its state
  int mode = 0;                        // 0: that of the commands

  /// From, the command's bits, to: the transitions of the standard.
  void obey(std::uint16_t control) {
    struct Row {
      std::uint16_t from, mask, value, to;
    };
    static constexpr Row kRows[] = {
        {0x0250, 0x0087, 0x0006, 0x0231}, {0x0231, 0x008F, 0x0007, 0x0233},
        {0x0231, 0x0082, 0x0000, 0x0250}, {0x0231, 0x0086, 0x0002, 0x0250},
        {0x0233, 0x008F, 0x000F, 0x1237}, {0x0233, 0x0087, 0x0006, 0x0231},
        {0x0233, 0x0082, 0x0000, 0x0250}, {0x0233, 0x0086, 0x0002, 0x0250},
        {0x1237, 0x008F, 0x0007, 0x0233}, {0x1237, 0x0087, 0x0006, 0x0231},
        {0x1237, 0x0082, 0x0000, 0x0250}, {0x1237, 0x0086, 0x0002, 0x0217},
        {0x0217, 0xFFFF, 0x0002, 0x0250}, {0x0217, 0x0082, 0x0000, 0x0250}};
    const bool reset = (control & 0x0080) != 0;
    if (word == 0x0218 && reset && reset_seen_low && !stays) {
      word = 0x0250;
    } else {
      for (const Row& row : kRows)
        if (!stays && word == row.from && (control & row.mask) == row.value) {
          word = row.to;
          break;
        }
    }
    reset_seen_low = !reset;
  }
};

struct ArmOfDrives {
  Cia402Settings settings;
  Drives drives;
  std::array<FakeDrive, kDof> fakes;
  Feedbacks feedbacks;
  DriveCommands commands;
  RobotState state;
  RobotCommand command;
  std::int64_t now_ns = 0;
  bool told = true;     // feedback is fresh
  bool answers = true;  // what the drives are asked by SDO
  bool measures_velocity = false;
  int silent = -1;  // joint whose feedback is not

  explicit ArmOfDrives(CommandMode mode = CommandMode::kEffort) {
    settings.rated_torque << 3.0, 3.0, 3.0, 3.0, 0.5, 0.5, 0.5;
    settings.brake_ms = 10;
    Message why;
    assert_int_equal(static_cast<int>(drives.configure(settings, Tool{}, 1000, 10000, why)), 0);
    const JointLimits limits;
    for (int j = 0; j < kDof; ++j)
      feedbacks[static_cast<std::size_t>(j)].position = static_cast<std::int32_t>(
          0.5 * (limits.q_min[j] + limits.q_max[j]) * 16777216.0 / 6.283185307179586);
    command.mode = mode;
    assert_int_equal(static_cast<int>(drives.attach(mode, feedbacks, why)), 0);
  }

  void answer(const ObjectRequest& request) {
    FakeDrive& drive = fake(request.joint);
    if (request.writes && request.object.index == 0x6060)
      drive.mode = static_cast<int>(request.value);
    const auto mode = static_cast<std::uint32_t>(mode_of(command.mode));
    drives.answer(drive.mode != 0 ? static_cast<std::uint32_t>(drive.mode) : mode);
  }
  void cycle(DriveRequest request) {
    for (std::size_t j = 0; j < kDof; ++j) {
      feedbacks[j].fresh = told && static_cast<int>(j) != silent;
      feedbacks[j].has_velocity = measures_velocity;
      feedbacks[j].statusword =
          static_cast<std::uint16_t>((fakes[j].word & ~fakes[j].hides) | fakes[j].shows);
    }
    drives.watch(feedbacks, now_ns);
    if (answers && drives.request().number != 0) answer(drives.request());
    drives.show(state);
    command.request = request;
    drives.step(command, commands, now_ns);
    for (std::size_t j = 0; j < kDof; ++j) {
      fakes[j].obey(commands[j].controlword);
      feedbacks[j].emergency = false;
    }
    now_ns += 1'000'000;
  }
  void cycles(int count, DriveRequest request) {
    for (int i = 0; i < count; ++i) cycle(request);
  }
  void arm() {
    cycles(30 + settings.held_ms(), DriveRequest::kArm);
    assert_true(all(DriveState::kEnabled));
  }
  bool all(DriveState wanted) const {
    for (const Drive& drive : state.drives)
      if (drive.state != wanted) return false;
    return true;
  }
  Drive& joint(int j) { return state.drives[static_cast<std::size_t>(j)]; }
  FakeDrive& fake(int j) { return fakes[static_cast<std::size_t>(j)]; }
};

}  // namespace tactus::cia402
