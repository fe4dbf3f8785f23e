// Numbers of a drive in SI units and back, against figures worked out by hand.
#include "hal/cia402/joint_units.hpp"
#include "tests/support/random.hpp"
#include "tests/support/testing.hpp"

namespace tactus::cia402 {
namespace {

constexpr double kPi = 3.141592653589793;

// Proves CAN-2.
void torque_is_in_thousandths_of_the_rated_torque(void**) {
  JointUnits wide{16777216.0, 1.0, 3.0, 1.0, 0.0};
  assert_int_equal(wide.torque(87.0), 29000);
  ASSERT_NEAR(wide.tau(29000), 87.0, 1e-12);
  JointUnits fine{16777216.0, 1.0, 0.5, 1.0, 0.0};
  assert_int_equal(fine.torque(-12.0), -24000);
  ASSERT_NEAR(fine.torque_step(), 0.5e-3, 1e-18);
}

void gear_and_direction_are_those_of_the_joint(void**) {
  const JointUnits units{4096.0, 100.0, 0.32, -1.0, 0.0};
  assert_int_equal(units.torque(16.0), -500);  // 0.16 N m at the motor
  ASSERT_NEAR(units.q(-409600), 2.0 * kPi, 1e-12);
  assert_int_equal(units.velocity(2.0 * kPi), -409600);
}

void the_offset_is_where_the_drive_counts_zero(void**) {
  const JointUnits units{16777216.0, 1.0, 3.0, -1.0, 0.25};
  ASSERT_NEAR(units.q(0), 0.25, 0.0);
  ASSERT_NEAR(units.q(4194304), 0.25 - 0.5 * kPi, 1e-12);
  assert_int_equal(units.position(0.25 - 0.5 * kPi), 4194304);
}

void every_number_survives_the_way_there_and_back(void**) {
  Random random{77};
  for (int i = 0; i < 20000; ++i) {
    const JointUnits units{16777216.0, random.uniform(0.5, 200.0), random.uniform(0.01, 10.0),
                           random.below(2) == 0 ? 1.0 : -1.0, random.uniform(-3.0, 3.0)};
    const auto torque = static_cast<std::int16_t>(random.below(65535) - 32767);
    assert_int_equal(units.torque(units.tau(torque)), torque);
    const auto count = static_cast<std::int32_t>(random.uniform(-2147483647.0, 2147483647.0));
    assert_int_equal(units.position(units.q(count)), count);
    assert_int_equal(units.velocity(units.dq(count)), count);
  }
}

void what_a_drive_cannot_say_is_its_largest_number(void**) {
  const JointUnits units{16777216.0, 1.0, 3.0, 1.0, 0.0};
  assert_int_equal(units.torque(1e9), 32767);
  assert_int_equal(units.torque(-1e300), -32767);
  assert_int_equal(units.torque(98.301), 32767);
  assert_int_equal(units.velocity(1e9), 2147483647);
  const double nan = std::nan("");
  assert_int_equal(units.torque(nan), 0);
  assert_int_equal(units.velocity(nan), 0);
  assert_int_equal(units.position(nan), 0);
}

/// The counter of a drive is followed past both ends of its 32 bits.
void a_counter_is_followed_beyond_its_end(void**) {
  Random random{5};
  std::int64_t truth = 2147480000;
  PositionCounter counter;
  counter.start(static_cast<std::int32_t>(truth), 0);
  for (int i = 0; i < 200000; ++i) {
    truth += random.below(2000001) - (i < 100000 ? 900000 : 1100000);
    assert_true(counter.follow(static_cast<std::int32_t>(static_cast<std::uint32_t>(truth))) ==
                truth);
  }
  const JointUnits units{16777216.0, 1.0, 3.0, 1.0, 0.0};
  assert_int_equal(units.position(units.q(3000000000)), -1294967296);
}

/// The numbers of a turn of an encoder, in every way in which a drive may write them.
void a_counter_that_begins_anew_at_a_turn_is_followed(void**) {
  constexpr std::int64_t kSize = 1000;
  constexpr std::int64_t kTurns[] = {16777216, 4096, 100003, 2147483648};
  for (const std::int64_t turn : kTurns)
    for (const std::int64_t first : {std::int64_t{0}, -turn / 2}) {
      Random random{11};
      std::int64_t truth = first;
      PositionCounter counter;
      const auto shown = [&](std::int64_t value) {
        const std::int64_t within = ((value - first) % turn + turn) % turn + first;
        return static_cast<std::int32_t>(static_cast<std::uint32_t>(within));
      };
      const auto added = truth - shown(truth);
      counter.start(shown(truth), added, turn);
      for (int i = 0; i < 4 * kSize; ++i) {
        truth += static_cast<std::int64_t>(
            random.uniform(i < 2 * kSize ? -0.4 : -0.49, i < 2 * kSize ? 0.49 : 0.4) *
            static_cast<double>(turn));
        assert_true(counter.follow(shown(truth)) == truth);
        assert_true(counter.added() == truth - shown(truth));
      }
    }
}

}  // namespace
}  // namespace tactus::cia402

int main() {
  using namespace tactus::cia402;
  const CMUnitTest tests[] = {
      cmocka_unit_test(torque_is_in_thousandths_of_the_rated_torque),
      cmocka_unit_test(gear_and_direction_are_those_of_the_joint),
      cmocka_unit_test(the_offset_is_where_the_drive_counts_zero),
      cmocka_unit_test(every_number_survives_the_way_there_and_back),
      cmocka_unit_test(what_a_drive_cannot_say_is_its_largest_number),
      cmocka_unit_test(a_counter_is_followed_beyond_its_end),
      cmocka_unit_test(a_counter_that_begins_anew_at_a_turn_is_followed),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
