// The arm behind the emulated drives: brakes, torque, stops and the drives' own loops.
#include <cmath>

#include "tests/drives/drives_bench.hpp"

namespace tactus::drives {
namespace {

constexpr double kIncrement = 6.28318530717958647693 / 16777216.0;  // rad
constexpr double kLsb_Nm[] = {3e-3, 3e-3, 3e-3, 3e-3, 0.5e-3, 0.5e-3, 0.5e-3};

std::int16_t permille(int joint, double tau_Nm) {
  return static_cast<std::int16_t>(std::lround(tau_Nm / kLsb_Nm[joint]));
}
void hold_gravity(DrivesBench& bench) {
  const JointVector g = bench.arm.arm().gravity();
  for (int i = 0; i < kDof; ++i) bench.torque[static_cast<std::size_t>(i)] = permille(i, g[i]);
}
double farthest(DrivesBench& bench, const JointVector& from) {
  return (bench.arm.arm().q() - from).cwiseAbs().maxCoeff();
}
bool all_are(const DrivesBench& bench, unsigned mask, unsigned word) {
  for (const Feedback& f : bench.feedback)
    if ((f.status & mask) != word) return false;
  return true;
}

void enabling_and_disabling_do_not_move_an_arm_whose_gravity_is_held(void**) {
  DrivesBench& bench = fresh();
  bench.configure(10);
  const JointVector q = bench.arm.arm().q();
  hold_gravity(bench);
  bench.enable();
  double most = 0.0;
  for (int i = 0; i < 400; ++i) {
    bench.cycle();
    most = std::max(most, farthest(bench, q));
  }
  assert_true(all_are(bench, 0xFFFF, 0x1237));
  bench.command_all(0x0007);
  for (int i = 0; i < 200; ++i) {
    bench.cycle();
    most = std::max(most, farthest(bench, q));
  }
  assert_true(all_are(bench, 0xFFFF, 0x0233));
  ASSERT_NEAR(most, 0.0, 2e-4);
  bench.torque.fill(20000);
  const JointVector rest = bench.arm.arm().q();
  bench.cycles(50);
  assert_true(bench.arm.arm().q() == rest);
}

/// Torque commands that move every joint a little.
void swing(DrivesBench& bench, const JointVector& g, int k) {
  for (int i = 0; i < kDof; ++i) {
    const double size = i < 4 ? 3.0 : 0.5;
    bench.torque[static_cast<std::size_t>(i)] = permille(i, g[i] + size * std::sin(0.05 * k + i));
  }
}

void the_plant_is_the_arm_driven_by_the_commands_of_the_cycle_before(void**) {
  static Arm reference;
  ASSERT_OK(reference.load(PlantParams()));
  DriveArmSettings settings = one_bus();
  settings.brake_release_s = 0.0;
  DrivesBench& bench = fresh(settings);
  bench.configure(10);
  const JointVector g = reference.gravity();
  hold_gravity(bench);
  bench.enable();
  JointVector tau;
  for (int k = 0; k < 300; ++k) {
    for (int i = 0; i < kDof; ++i) tau[i] = bench.torque[static_cast<std::size_t>(i)] * kLsb_Nm[i];
    swing(bench, g, k);
    bench.cycle();
    reference.step(tau, 1e-3);
    for (int i = 0; i < kDof; ++i) {
      const Feedback& f = bench.feedback[static_cast<std::size_t>(i)];
      ASSERT_NEAR(bench.arm.arm().q()[i], reference.q()[i], 1e-12);
      ASSERT_NEAR(f.position * kIncrement, reference.q()[i], 0.51 * kIncrement);
      ASSERT_NEAR(f.torque * kLsb_Nm[i], tau[i], 0.51 * kLsb_Nm[i]);
    }
  }
  assert_true(reference.dq().norm() > 0.1);
}

void velocity_is_in_increments_per_second(void**) {
  DriveArmSettings settings = one_bus();
  settings.brake_release_s = 0.0;
  DrivesBench& bench = fresh(settings);
  bench.configure(10);
  bench.enable();
  bench.cycles(40);  // it falls
  for (int i = 0; i < kDof; ++i) {
    const auto velocity = static_cast<std::int32_t>(bench.get(i + 1, 0x606C, 0));
    ASSERT_NEAR(velocity, bench.arm.arm().dq()[i] / kIncrement, 0.51);
  }
}

void one_closed_brake_holds_its_joint_while_the_others_fall(void**) {
  DrivesBench& bench = fresh();
  bench.configure(10);
  hold_gravity(bench);
  bench.enable();
  bench.cycles(200);
  bench.controlword[1] = 0x0000;
  bench.cycle();
  const double q = bench.arm.arm().q()[1];
  bench.torque.fill(0);
  for (int i = 0; i < 100; ++i) {
    bench.cycle();
    ASSERT_NEAR(bench.arm.arm().q()[1], q, 2e-5);
  }
  assert_true(std::abs(bench.arm.arm().dq()[3]) > 0.3);
}

void a_quick_stop_brings_a_falling_arm_to_rest(void**) {
  DrivesBench& bench = fresh();
  bench.configure(10);
  hold_gravity(bench);
  bench.enable();
  bench.cycles(200);
  bench.torque.fill(0);
  bench.cycles(100);
  const double speed = bench.arm.arm().dq().cwiseAbs().maxCoeff();
  assert_true(speed > 0.3);
  const JointVector q = bench.arm.arm().q();
  bench.command_all(0x0002);
  bench.cycles(3);
  assert_true(all_are(bench, 0x6F, 0x07));
  bench.cycles(400);
  assert_true(all_are(bench, 0x4F, 0x40));
  ASSERT_NEAR(bench.arm.arm().dq().norm(), 0.0, 1e-9);
  // By 10 rad/s^2 the way is v^2 / 20; the loops add a little.
  ASSERT_NEAR(farthest(bench, q), speed * speed / 20.0, 0.02);
}

void an_offset_adds_to_the_target_torque_and_both_are_limited(void**) {
  DrivesBench& bench = fresh();
  bench.configure(10);
  bench.put(4, 0x60B2, 0, 500, 2);
  bench.put(4, 0x6072, 0, 2000, 2);
  bench.torque[3] = 1000;
  bench.enable();
  bench.cycles(2);
  assert_int_equal(bench.feedback[3].torque, 1500);
  bench.torque[3] = 1600;
  bench.cycles(2);
  assert_int_equal(bench.feedback[3].torque, 2000);
  assert_int_equal(bench.get(4, 0x6074, 0), 2000);
  assert_int_equal(bench.feedback[3].status & 0x0800, 0x0800);
  bench.torque[3] = -32768;
  bench.cycles(2);
  assert_int_equal(bench.feedback[3].torque, -2000);
}

void drives_that_compensate_gravity_hold_the_arm_with_no_torque(void**) {
  DriveArmSettings settings = one_bus();
  settings.gravity_by_drive = true;
  DrivesBench& bench = fresh(settings);
  bench.configure(10);
  const JointVector q = bench.arm.arm().q();
  bench.enable();
  bench.cycles(1000);
  assert_true(all_are(bench, 0xFFFF, 0x1237));
  ASSERT_NEAR(farthest(bench, q), 0.0, 1e-5);
}

void a_joint_that_is_too_fast_is_a_fault(void**) {
  DrivesBench& bench = fresh();
  bench.configure(10);
  bench.enable();
  for (int i = 0; i < 2000 && (bench.feedback[3].status & 0x4F) != 0x08; ++i) {
    bench.cycle();
    assert_true(std::abs(bench.arm.arm().dq()[3]) < 3.3);  // 6080h is 30 rpm
  }
  assert_int_equal(bench.get(4, 0x603F, 0), 0x8400);
}

/// CSP with controlword and position in one command PDO.
struct Positioning {
  DrivesBench& bench;
  std::array<std::int32_t, kDof> target{};

  explicit Positioning(DrivesBench& with) : bench(with) {
    bench.boot();
    for (unsigned n = 1; n <= kDof; ++n) {
      const int node = static_cast<int>(n);
      bench.put(node, 0x6060, 0, 8, 1);
      bench.map(node, 0x1400, 0x200 + n, 1, {0x60400010, 0x607A0020});
      bench.map(node, 0x1800, 0x180 + n, 1, {0x60410010, 0x60640020, 0x60770010});
      target[n - 1] = static_cast<std::int32_t>(bench.get(node, 0x6064, 0));
    }
    bench.send(0x000, {0x01, 0x00});
  }
  void cycle(unsigned word) {
    for (unsigned i = 0; i < kDof; ++i) {
      const auto t = static_cast<std::uint32_t>(target[i]);
      bench.send(0x201 + i, {word, 0, t & 0xFF, t >> 8 & 0xFF, t >> 16 & 0xFF, t >> 24});
    }
    bench.now_ns += 1'000'000;
    bench.sync();
    bench.arm.advance(bench.now_ns);
    while (bench.take()) bench.note_feedback();
  }
  void enable() {
    for (const unsigned word : {6U, 7U, 15U}) cycle(word);
    for (int i = 0; i < 200; ++i) cycle(15);
  }
};

void positions_are_held_when_the_brakes_open_and_followed_afterwards(void**) {
  Positioning csp(fresh());
  const JointVector q = csp.bench.arm.arm().q();
  csp.enable();
  assert_true(all_are(csp.bench, 0xFFFF, 0x1237));
  ASSERT_NEAR(farthest(csp.bench, q), 0.0, 2e-4);
  for (int k = 1; k <= 1000; ++k) {  // 0.2 rad/s on every joint
    for (std::int32_t& target : csp.target) target += 534;
    csp.cycle(15);
  }
  for (int i = 0; i < kDof; ++i)
    ASSERT_NEAR(csp.bench.arm.arm().q()[i], csp.target[static_cast<std::size_t>(i)] * kIncrement,
                0.003);
  for (int k = 0; k < 1000; ++k) csp.cycle(15);
  for (int i = 0; i < kDof; ++i)
    ASSERT_NEAR(csp.bench.arm.arm().q()[i], csp.target[static_cast<std::size_t>(i)] * kIncrement,
                1e-4);
}

void a_target_that_jumps_is_a_following_error(void**) {
  Positioning csp(fresh());
  csp.enable();
  csp.target[0] += 534000 + 1000;  // beyond the window of 6065h
  csp.cycle(15);
  csp.cycle(15);
  for (int i = 0; i < 1000 && (csp.bench.feedback[0].status & 0x4F) != 0x08; ++i) csp.cycle(15);
  assert_int_equal(csp.bench.get(1, 0x603F, 0), 0x8611);
  assert_int_equal(csp.bench.get(2, 0x603F, 0), 0);
}

void velocities_are_followed_with_their_offset(void**) {
  DrivesBench& bench = fresh();
  bench.configure(9);
  bench.enable();
  bench.cycles(200);
  bench.put(1, 0x60FF, 0, 200000, 4);
  bench.put(1, 0x60B1, 0, 67000, 4);  // 0.1 rad/s in all
  bench.cycles(500);
  ASSERT_NEAR(bench.arm.arm().dq()[0], 267000 * kIncrement, 2e-3);
  ASSERT_NEAR(bench.arm.arm().dq()[3], 0.0, 2e-3);
}

void three_buses_move_the_arm_as_one_does(void**) {
  static std::array<Feedback, kDof> single;
  for (const bool three : {false, true}) {
    DrivesBench& bench = fresh(three ? three_buses() : one_bus());
    bench.configure(10);
    hold_gravity(bench);
    const JointVector g = bench.arm.arm().gravity();
    bench.enable();
    for (int k = 0; k < 400; ++k) {
      swing(bench, g, k);
      bench.cycle();
    }
    if (!three) single = bench.feedback;
    for (std::size_t i = 0; i < kDof && three; ++i) {
      assert_int_equal(bench.feedback[i].position, single[i].position);
      assert_int_equal(bench.feedback[i].torque, single[i].torque);
    }
  }
}

void a_bus_without_sync_delays_no_other(void**) {
  DrivesBench& bench = fresh(three_buses());
  bench.configure(10);
  hold_gravity(bench);
  bench.enable();
  bench.cycles(10);
  const std::int64_t periods = bench.arm.periods();
  for (int i = 0; i < 50; ++i) {
    bench.send_commands();
    bench.now_ns += 1'000'000;
    bench.send(0x080, {}, 0);
    bench.send(0x080, {}, 2);
    bench.expect_nothing(0x184);
  }
  assert_int_equal(bench.arm.periods() - periods, 50);
}

void without_a_master_the_arm_follows_the_clock(void**) {
  DrivesBench& bench = fresh();
  bench.configure(10);
  for (int n = 1; n <= kDof; ++n) {
    bench.put(n, 0x1016, 1, 0x007F001E, 4);
    bench.put(n, 0x1029, 1, 1, 1);
    bench.put(n, 0x6007, 0, 3, 2);
  }
  bench.send(0x77F, {0x05});
  hold_gravity(bench);
  bench.enable();
  for (int i = 0; i < 20; ++i) {
    bench.send(0x77F, {0x05});
    bench.cycles(10);
  }
  bench.torque.fill(0);
  bench.cycles(20);
  bench.run_ms(500);
  for (int i = 0; i < kDof; ++i)
    assert_int_equal(bench.arm.node(i).axis().statusword() & 0x4F, 0x40);
  ASSERT_NEAR(bench.arm.arm().dq().norm(), 0.0, 1e-9);
}

}  // namespace
}  // namespace tactus::drives

int main() {
  using namespace tactus::drives;
  const CMUnitTest tests[] = {
      cmocka_unit_test(enabling_and_disabling_do_not_move_an_arm_whose_gravity_is_held),
      cmocka_unit_test(the_plant_is_the_arm_driven_by_the_commands_of_the_cycle_before),
      cmocka_unit_test(velocity_is_in_increments_per_second),
      cmocka_unit_test(one_closed_brake_holds_its_joint_while_the_others_fall),
      cmocka_unit_test(a_quick_stop_brings_a_falling_arm_to_rest),
      cmocka_unit_test(an_offset_adds_to_the_target_torque_and_both_are_limited),
      cmocka_unit_test(drives_that_compensate_gravity_hold_the_arm_with_no_torque),
      cmocka_unit_test(a_joint_that_is_too_fast_is_a_fault),
      cmocka_unit_test(positions_are_held_when_the_brakes_open_and_followed_afterwards),
      cmocka_unit_test(a_target_that_jumps_is_a_following_error),
      cmocka_unit_test(velocities_are_followed_with_their_offset),
      cmocka_unit_test(three_buses_move_the_arm_as_one_does),
      cmocka_unit_test(a_bus_without_sync_delays_no_other),
      cmocka_unit_test(without_a_master_the_arm_follows_the_clock),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
