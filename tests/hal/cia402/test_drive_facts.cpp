// What a drive says of its numbers, against what the file says of them. The expected units are
// worked out by hand from CiA 402-2 and the codes of CiA 303-2.
#include "hal/cia402/drive_facts.hpp"

#include <cmath>
#include <cstring>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "hal/cia402/joint_units.hpp"
#include "kernel/core/joint_limits.hpp"
#include "tests/support/testing.hpp"

namespace tactus::cia402 {
namespace {

struct Said {
  Object object;
  std::uint32_t value;
};
using Sayings = std::vector<Said>;

constexpr Said kTurn = {kEncoderIncrements, 16777216}, kPerTurn = {kEncoderRevolutions, 1};

/// The drive of joint 1, which the file describes as `drive`.
struct Drive1 {
  Cia402Settings drive;
  StartupFindings findings;
  Message why;

  Drive1() { drive.rated_torque.setConstant(3.0); }
  Status judge(const Sayings& sayings, bool velocities = true) {
    DriveFacts facts;
    for (const Said& said : sayings)
      for (std::uint32_t row = 0; row < kFactCount; ++row)
        if (kFacts[row].object.mapping() == said.object.mapping()) facts.set(row, said.value);
    why = {};
    TRY(facts.judge_identity(drive, 0, findings, why));
    return facts.judge(drive, 0, velocities, findings, why);
  }
  bool says(const char* text) const { return std::strstr(why.c_str(), text) != nullptr; }
};

// Proves CAN-17.

void units_of_velocity_are_those_that_the_drive_names(void**) {
  struct Row {
    double increments, expected;
    Sayings says;
  };
  const Row rows[] = {
      {16777216.0, 16777216.0, {kTurn, kPerTurn, {kVelocityUnit, 0x00B50300}}},
      {16777216.0, 60.0, {kTurn, kPerTurn, {kVelocityUnit, 0x00B44700}}},     // rev/min
      {16777216.0, 60000.0, {kTurn, kPerTurn, {kVelocityUnit, 0xFDB44700}}},  // 0.001 rev/min
      {16777216.0, 1.0, {kTurn, kPerTurn, {kVelocityUnit, 0x00B40300}}},      // rev/s
      {16777216.0, 21600.0, {kTurn, kPerTurn, {kVelocityUnit, 0x00414700}}},  // degrees/min
      {4096.0,
       4096.0,  // 8192 of two turns; the unit of velocities is that of the positions per s
       {{kEncoderIncrements, 8192}, {kEncoderRevolutions, 2}, {kVelocityUnit, 0x00000300}}},
      {720.0,
       1.2,  // a gear 50:1 inside the drive: its shaft, in 36000 units per turn, rev/min
       {kTurn,
        kPerTurn,
        {kGearMotorTurns, 50},
        {kGearShaftTurns, 1},
        {kFeedConstant, 36000},
        {kFeedTurns, 1},
        {kVelocityUnit, 0x00B44700}}},
      {360000.0,
       360000.0,  // thousandths of a degree, and those per second
       {{kPositionUnit, 0xFD410000}, {kVelocityUnit, 0xFD410300}}},
      {6283185.307,
       6283185.307,  // millionths of a radian
       {{kPositionUnit, 0xFA100000}, {kVelocityUnit, 0x00000300}}}};
  for (const Row& row : rows) {
    Drive1 one;
    one.drive.increments.setConstant(row.increments);
    const Status status = one.judge(row.says);
    if (status != Status::kOk) print_error("%s\n", one.why.c_str());
    ASSERT_OK(status);
    ASSERT_NEAR(one.findings.velocity_units[0] / row.expected, 1.0, 1e-9);
  }
}

/// What is not known is asked for; what the file states must not contradict the drive.
void a_unit_of_velocity_that_is_not_known_is_asked_for_by_name(void**) {
  const Sayings silent = {kTurn, kPerTurn};
  for (const std::uint32_t unit :
       {0x00000000U, 0x00B40000U, 0x00010300U, 0x00B44800U, 0x7FB44700U, 0x80B44700U}) {
    Drive1 one;
    ASSERT_STATUS(one.judge({kTurn, kPerTurn, {kVelocityUnit, unit}}), Status::kRefusedByRobot);
    assert_true(one.says("the unit of its velocities is not known: 60A9h is "));
    assert_true(one.says("add to [cia402]: velocity_units"));
  }
  Drive1 one;
  ASSERT_STATUS(one.judge(silent), Status::kRefusedByRobot);
  assert_true(one.says("it has no 60A9h"));
  ASSERT_OK(one.judge(silent, false));
  one.drive.velocity_units.setConstant(60.0);
  ASSERT_OK(one.judge(silent));
  assert_true(one.findings.velocity_units[0] == 60.0);
  ASSERT_STATUS(one.judge({kTurn, kPerTurn, {kVelocityUnit, 0x00B50300}}), Status::kRefusedByRobot);
  assert_true(one.says("its velocities have 16777216 units per motor revolution per second"));
  assert_true(one.says("60A9h is 00B50300h), [cia402] velocity_units is 60;"));

  Drive1 scaled;
  const Sayings factor = {
      kTurn, kPerTurn, {kVelocityUnit, 0x00B50300}, {kVelocityFactor, 5}, {kVelocityDivisor, 3}};
  ASSERT_STATUS(scaled.judge(factor), Status::kRefusedByRobot);
  assert_true(scaled.says("6096h, is not 1"));
  scaled.drive.velocity_units.setConstant(16777216.0);
  ASSERT_OK(scaled.judge(factor));
}

void positions_with_other_units_than_in_the_file_are_refused(void**) {
  const Sayings rows[] = {{{kEncoderIncrements, 16777215}, kPerTurn},
                          {kTurn, {kEncoderRevolutions, 2}},
                          {kTurn, {kEncoderRevolutions, 0}},
                          {kTurn, kPerTurn, {kFeedConstant, 4096}, {kFeedTurns, 1}},
                          {kTurn, kPerTurn, {kFeedConstant, 16777216}, {kFeedTurns, 0}},
                          {{kPositionUnit, 0x00B40000}},
                          {{kPositionUnit, 0x00010000}}};  // metres
  for (const Sayings& says : rows) {
    Drive1 one;
    ASSERT_STATUS(one.judge(says, false), Status::kRefusedByRobot);
    assert_true(one.says("its positions have "));
    assert_true(one.says("[cia402] increments is "));
  }
  Drive1 one;
  // The drive says nothing, or that it counts in increments: the file alone says how many.
  ASSERT_OK(one.judge({}, false));
  ASSERT_OK(one.judge({{kPositionUnit, 0x00B50000}}, false));
  ASSERT_OK(one.judge({{kPositionUnit, 0x00000000}, {kVelocityUnit, 0x00B50300}}));
  ASSERT_NEAR(one.findings.velocity_units[0], 16777216.0, 1e-6);
}

/// To the drive's step, by default and as the file states it.
void a_torque_limit_below_what_is_needed_is_refused(void**) {
  const double step_Nm = 3e-3, most_Nm = JointLimits{}.tau_max[0];
  const auto needed = static_cast<std::uint32_t>(std::ceil(most_Nm / step_Nm - 0.5));
  Drive1 one;
  ASSERT_OK(one.judge({{kMaxTorque, needed}}, false));
  for (const std::uint32_t most : {needed - 1, 14500U, 0U}) {
    ASSERT_STATUS(one.judge({{kMaxTorque, most}}, false), Status::kRefusedByRobot);
    assert_true(one.says("its own torque limit (6072h:0) is "));
    assert_true(one.says("raise it in the drive"));
    assert_true(one.says("or say in [cia402] torque_limit") == (most > 0));
  }
  one.drive.torque_limit.setConstant(43.5);
  ASSERT_OK(one.judge({{kMaxTorque, 14500}}, false));
  ASSERT_STATUS(one.judge({{kMaxTorque, 14499}}, false), Status::kRefusedByRobot);
  assert_true(one.says("less than 43.5 N m, [cia402] torque_limit; correct"));
  ASSERT_STATUS(one.judge({{kRatedTorque, 3001}}, false), Status::kRefusedByRobot);
  assert_true(one.says("rated torque in mN m (6076h:0) is 3001, expected 3000"));
}

void a_drive_with_another_serial_number_is_refused(void**) {
  Drive1 one;
  ASSERT_OK(one.judge({{kSerialNumber, 4294967295U}}, false));
  one.drive.serial[0] = 4294967294.0;
  ASSERT_OK(one.judge({{kSerialNumber, 4294967294U}}, false));
  ASSERT_STATUS(one.judge({{kSerialNumber, 4294967295U}}, false), Status::kRefusedByRobot);
  assert_true(one.says("(1018h:4) is 4294967295, [cia402] serial is 4294967294; it is the drive"));
  ASSERT_STATUS(one.judge({}, false), Status::kRefusedByRobot);
  assert_true(one.says("is not told"));
}

void serial_numbers_are_told_while_a_joint_has_none_in_the_file(void**) {
  Cia402Settings file;
  StartupFindings findings;
  for (int j = 0; j < kDof; ++j) findings.serials[j] = 4294967295.0 - j;
  const Message line = unstated(file, findings);
  std::istringstream words(line.c_str());
  std::string section, key, equals;
  words >> section >> key >> equals;
  assert_string_equal((section + " " + key + " " + equals).c_str(), "[cia402] serial =");
  for (int j = 0; j < kDof; ++j) {
    assert_false(unstated(file, findings).empty());
    words >> file.serial[j];
    assert_true(file.serial[j] == findings.serials[j]);
  }
  assert_true(unstated(file, findings).empty());
  findings.serials[2] = 0.0;  // one that has none cannot be told from another
  assert_true(unstated(Cia402Settings(), findings).empty());
}

/// Both ways, over random units: a velocity of the joint is so many units.
void velocities_are_converted_by_their_own_unit(void**) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> speed(-3.0, 3.0), share(0.0, 1.0);
  for (int i = 0; i < 10000; ++i) {
    JointUnits units;
    units.gear = std::pow(10.0, 2.0 * share(random));
    units.speed = std::pow(10.0, 1.0 + 6.0 * share(random));
    units.direction = i % 2 == 0 ? 1.0 : -1.0;
    const double dq = speed(random);
    const double motor_turns_s = units.direction * dq * units.gear / (2.0 * 3.14159265358979324);
    const double expected = std::round(motor_turns_s * units.speed);
    if (std::abs(expected) > 2e9) continue;
    assert_true(std::abs(units.velocity(dq) - expected) <= 1.0);
    ASSERT_NEAR(units.dq(units.velocity(dq)), dq, 0.51 * units.speed_step());
  }
}

}  // namespace
}  // namespace tactus::cia402

int main() {
  using namespace tactus::cia402;
  const CMUnitTest tests[] = {
      cmocka_unit_test(units_of_velocity_are_those_that_the_drive_names),
      cmocka_unit_test(a_unit_of_velocity_that_is_not_known_is_asked_for_by_name),
      cmocka_unit_test(positions_with_other_units_than_in_the_file_are_refused),
      cmocka_unit_test(a_torque_limit_below_what_is_needed_is_refused),
      cmocka_unit_test(a_drive_with_another_serial_number_is_refused),
      cmocka_unit_test(serial_numbers_are_told_while_a_joint_has_none_in_the_file),
      cmocka_unit_test(velocities_are_converted_by_their_own_unit),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
