// Homing in arming, of drives whose every bit is typed here: what they say of it, and what it
// means.
#include "tests/hal/cia402/arm_of_drives.hpp"

namespace tactus::cia402 {
namespace {

constexpr int kHomed = 2;  // joint, from 0
constexpr std::uint16_t kStart = 0x0010, kReached = 0x0400, kAttained = 0x1000, kError = 0x2000,
                        kOwn = 0x4000;

/// Seven drives that know their positions, but for one that has lost it.
struct HomingArm : ArmOfDrives {
  std::uint16_t ends = kReached | kAttained | kOwn;  ///< bits at the end of homing
  int after = 20;                                    ///< cycles from its start to its end
  std::int32_t home = 0;                             ///< its count then
  int started = 0;                                   ///< cycles since the start

  HomingArm() {
    settings.referenced_bit = 14;
    settings.homing_method[kHomed] = -3;
    for (FakeDrive& drive : fakes) drive.shows = kOwn;
    fake(kHomed).shows = 0;
    home = feedbacks[kHomed].position;
    attach();
  }
  void attach() {
    Message why;
    for (std::size_t j = 0; j < kDof; ++j)
      feedbacks[j].statusword = static_cast<std::uint16_t>(fakes[j].word | fakes[j].shows);
    ASSERT_OK(drives.attach(command.mode, feedbacks, why));
  }
  /// What the drive does after the commands of a cycle.
  void follow() {
    FakeDrive& drive = fake(kHomed);
    const bool homes = drive.mode == 6;
    drive.hides = homes ? kAttained : 0;
    if (!homes) drive.shows &= kOwn;
    if ((commands[kHomed].controlword & kStart) == 0) return;
    assert_true(homes);
    if (++started != after) return;
    drive.shows = ends;
    feedbacks[kHomed].position = home;
  }
  /// Arms, and judges every cycle: until the drive has ended, it alone is enabled.
  void home_and_arm(int most = 1000) {
    for (int i = 0;
         i < most && !all(DriveState::kEnabled) && drives.phase() != ArmingPhase::kFailed; ++i) {
      cycle(DriveRequest::kArm);
      follow();
      const bool homed = (fake(kHomed).shows & kOwn) != 0;
      for (int j = 0; j < kDof && !homed; ++j) {
        if (j != kHomed) assert_true(commands[static_cast<std::size_t>(j)].controlword != 0x000F);
        assert_int_equal(commands[static_cast<std::size_t>(j)].target_torque, 0);
      }
    }
  }
  void expect_refused(const char* text) {
    home_and_arm();
    const Message why = drives.why();
    if (std::strstr(why.c_str(), text) == nullptr) print_error("%s\n", why.c_str());
    assert_non_null(std::strstr(why.c_str(), text));
    for (const DriveCommand& sent : commands) assert_int_equal(sent.controlword & 0x0008, 0);
    cycle(DriveRequest::kArm);
    ASSERT_STATUS(joint(kHomed).reason, Status::kNotReferenced);
  }
};

// Proves CAN-21.
void homing_ends_where_the_drive_says_and_arming_goes_on(void**) {
  HomingArm arm;
  arm.home += 100000;
  arm.home_and_arm();
  assert_true(arm.all(DriveState::kEnabled));
  assert_int_equal(arm.fake(kHomed).mode, 10);
  const JointLimits limits;
  const double middle = 0.5 * (limits.q_min[kHomed] + limits.q_max[kHomed]);
  ASSERT_NEAR(arm.state.q[kHomed], middle + 100000 * 6.283185307179586 / 16777216.0, 1e-6);
}

void a_drive_that_shows_its_reference_is_not_homed(void**) {
  HomingArm arm;
  arm.fake(kHomed).shows = kOwn;
  arm.attach();
  arm.home_and_arm();
  assert_true(arm.all(DriveState::kEnabled));
  assert_int_equal(arm.started, 0);
}

/// Bits of an earlier homing are there until the drive has taken the new start.
void what_is_left_of_an_earlier_homing_says_nothing(void**) {
  for (const int left : {int{kError}, kError | kReached, kAttained | kReached}) {
    HomingArm arm;
    arm.after = 3;
    arm.ends = static_cast<std::uint16_t>(left);
    for (int i = 0; i < 1000 && arm.started < 7; ++i) {
      arm.cycle(DriveRequest::kArm);
      arm.follow();
    }
    assert_int_equal(arm.drives.phase(), ArmingPhase::kHoming);
    arm.fake(kHomed).shows = 0;
    arm.cycles(50, DriveRequest::kArm);
    assert_int_equal(arm.drives.phase(), ArmingPhase::kHoming);
    arm.fake(kHomed).shows = kReached | kAttained | kOwn;
    arm.home_and_arm();
    assert_true(arm.all(DriveState::kEnabled));
  }
}

void an_end_that_is_none_is_refused_in_its_words(void**) {
  HomingArm at_rest;
  at_rest.ends = kError | kReached;
  at_rest.expect_refused("joint 3: homing by method -3 ended in an error (bit 13) at standstill");
  HomingArm moving;
  moving.ends = kError;
  moving.expect_refused("ended in an error (bit 13) while it moved");
  HomingArm silent;
  silent.ends = kReached | kAttained;
  silent.expect_refused(
      "joint 3: has ended homing by method -3 but does not show [cia402] referenced_bit, 14 "
      "(statusword 0233h)");
  HomingArm outside;
  outside.home = 16777216;
  outside.expect_refused(
      "joint 3: is homed, and its position is then 6.28319 rad, above the end of its range, 2.8973 "
      "rad; correct");
  HomingArm endless;
  endless.after = 1 << 20;
  endless.settings.homing_ms = 500;
  endless.expect_refused(
      "joint 3: homing by method -3 does not end within [cia402] homing_ms, 500 ms (statusword "
      "0237h)");
}

/// Until its drive moves.
void begin_homing(HomingArm& arm) {
  for (int i = 0; i < 1000 && arm.started < 3; ++i) {
    arm.cycle(DriveRequest::kArm);
    arm.follow();
  }
  assert_int_equal(arm.started, 3);
}

void expect_all_stopped(const HomingArm& arm) {
  for (const DriveCommand& sent : arm.commands) assert_int_equal(sent.controlword, 0x0002);
}

void a_drive_that_reports_an_error_in_its_homing_is_stopped(void**) {
  HomingArm arm;
  begin_homing(arm);
  arm.feedbacks[kHomed].emergency = true;
  arm.feedbacks[kHomed].error_code = 0x8611;
  arm.cycle(DriveRequest::kArm);
  expect_all_stopped(arm);
  assert_non_null(std::strstr(arm.drives.why().c_str(), "joint 3: following error"));
}

void a_drive_that_leaves_operation_in_its_homing_is_not_enabled_again(void**) {
  for (const int word : {0x0231, 0x0233, 0x0217, 0x021F}) {
    HomingArm arm;
    begin_homing(arm);
    arm.fake(kHomed).word = static_cast<std::uint16_t>(word);
    arm.cycle(DriveRequest::kArm);
    expect_all_stopped(arm);
    arm.cycle(DriveRequest::kArm);
    ASSERT_STATUS(arm.joint(kHomed).reason, Status::kDriveFault);
  }
}

/// A mode that changes under a drive that is stopping would take its torque away.
void a_drive_stops_in_the_mode_in_which_it_was_homed(void**) {
  HomingArm arm;
  begin_homing(arm);
  for (int i = 0; i < 20; ++i) {
    arm.cycle(DriveRequest::kDisable);
    if (i == 0) expect_all_stopped(arm);
    for (int j = 0; j < kDof; ++j)
      assert_int_equal(arm.commands[static_cast<std::size_t>(j)].homes, j == kHomed);
  }
}

/// Its own bit may come after the end of the homing mode.
void a_reference_that_is_shown_late_is_awaited(void**) {
  HomingArm arm;
  arm.ends = kReached | kAttained;
  arm.home_and_arm(300);
  assert_int_equal(arm.drives.phase(), ArmingPhase::kSwitchingOn);
  arm.fake(kHomed).shows = kOwn;
  arm.home_and_arm();
  assert_true(arm.all(DriveState::kEnabled));
}

/// Somebody else may home a drive between connecting and arming.
void a_drive_is_not_enabled_outside_its_range_though_it_was_homed_elsewhere(void**) {
  HomingArm arm;
  arm.feedbacks[kHomed].position = 16777216;
  arm.attach();
  arm.fake(kHomed).shows = kOwn;
  arm.expect_refused("is homed, and its position is then 6.28319 rad");
  assert_int_equal(arm.started, 0);
}

/// The display may change at any time until step_ms.
void a_mode_that_is_shown_late_is_awaited_until_its_time(void**) {
  for (const int late : {100, 600}) {
    HomingArm arm;
    arm.settings.step_ms = 500;
    arm.drives.~Drives();
    new (&arm.drives) Drives;
    Message why;
    ASSERT_OK(arm.drives.configure(arm.settings, Tool{}, 1000, 100000, why));
    arm.attach();
    for (int i = 0; i < late; ++i) {
      arm.cycle(DriveRequest::kArm);
      arm.fake(kHomed).mode = 9;
    }
    if (late < 500) {
      arm.fake(kHomed).mode = 6;
      arm.home_and_arm();
      assert_true(arm.all(DriveState::kEnabled));
      continue;
    }
    assert_non_null(std::strstr(arm.drives.why().c_str(),
                                "joint 3: its display of the mode of operation (6061h) does not "
                                "become homing within [cia402] step_ms, but is cyclic"));
    ASSERT_STATUS(arm.joint(kHomed).reason, Status::kDriveFault);
  }
}

void expect_settings_refused(const Cia402Settings& settings, int arming_ms, const char* text) {
  Drives drives;
  Message why;
  ASSERT_STATUS(drives.configure(settings, Tool{}, 1000, arming_ms, why), Status::kBadValue);
  if (std::strstr(why.c_str(), text) == nullptr) print_error("%s\n", why.c_str());
  assert_non_null(std::strstr(why.c_str(), text));
}

void settings_that_would_home_without_need_or_in_no_time_are_refused(void**) {
  Cia402Settings settings;
  settings.rated_torque.setConstant(3.0);
  settings.homing_method[4] = 35;
  for (const int bit : {-1, 7, 9, 10, 12, 13}) {
    settings.referenced_bit = bit;
    expect_settings_refused(settings, 600000, "joint 5: [cia402] homing_method is 35 with");
  }
  settings.referenced_bit = 15;
  settings.homing_method[5] = 17.5;
  expect_settings_refused(settings, 600000, "joint 6: [cia402] homing_method is 17.5; methods");
  settings.homing_method[5] = 17;
  expect_settings_refused(
      settings, 64299,
      "[executive] arming_ms is 64299, less than the 64300 ms that arming may take: [cia402] "
      "homing_ms, 30000, and step_ms for 2 joints");
  Drives drives;
  Message why;
  ASSERT_OK(drives.configure(settings, Tool{}, 1000, 64300, why));
}

}  // namespace
}  // namespace tactus::cia402

int main() {
  using namespace tactus::cia402;
  const CMUnitTest tests[] = {
      cmocka_unit_test(homing_ends_where_the_drive_says_and_arming_goes_on),
      cmocka_unit_test(a_drive_that_shows_its_reference_is_not_homed),
      cmocka_unit_test(what_is_left_of_an_earlier_homing_says_nothing),
      cmocka_unit_test(an_end_that_is_none_is_refused_in_its_words),
      cmocka_unit_test(a_drive_that_reports_an_error_in_its_homing_is_stopped),
      cmocka_unit_test(a_drive_that_leaves_operation_in_its_homing_is_not_enabled_again),
      cmocka_unit_test(a_drive_stops_in_the_mode_in_which_it_was_homed),
      cmocka_unit_test(a_reference_that_is_shown_late_is_awaited),
      cmocka_unit_test(a_drive_is_not_enabled_outside_its_range_though_it_was_homed_elsewhere),
      cmocka_unit_test(a_mode_that_is_shown_late_is_awaited_until_its_time),
      cmocka_unit_test(settings_that_would_home_without_need_or_in_no_time_are_refused),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
