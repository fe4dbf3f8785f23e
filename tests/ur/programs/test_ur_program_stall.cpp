// Tests the target that the uploaded program passes to servoj when the control computer pauses for
// some cycles and then resumes where it was.
#include <optional>

#include "tests/ur/programs/ur_servo_bench.hpp"

namespace {

using namespace tactus;
using namespace tactus::ur;

/// The joint target that the program gave in the last cycle, computed from servoj's motion, because
/// the law is linear in its target. `q`, `dq`: before the cycle.
double given(ServoBench& bench, double q, double dq) {
  const ServoLaw law{2000.0, 0.03};
  double free = q, weight = 0.0, unit_speed = 0.0;
  law.step(0.0, kCycle_s, free, dq);
  law.step(1.0, kCycle_s, weight, unit_speed);
  return (bench.target()[0] - free) / weight;
}

/// Joint 1 at a constant speed, and the program's target, in steps of one cycle's way.
struct EvenMotion {
  static constexpr double kStep = 0.6 * kCycle_s;
  ServoBench bench;
  Joints q = ProgramBench::settings().initial_q;
  double given_before = 0.0, way = 0.0, way_before = 0.0;
  double acceleration = 0.0;  ///< of the robot's own joint target, rad/s^2

  void start() {
    bench.start();
    bench.set(q);
    for (int k = 0; k < 50; ++k) tick(1);
  }
  /// Runs one cycle after `set_points` have arrived.
  void tick(int set_points) {
    q[0] += set_points * kStep;
    if (set_points > 0) {
      bench.count += set_points - 1;
      bench.set(q);
    }
    const double before = bench.target()[0], speed = bench.machine().motion.dq()[0];
    bench.tick();
    acceleration = (bench.machine().motion.dq()[0] - speed) / kCycle_s;
    const double now = given(bench, before, speed);
    way_before = way;
    way = (now - given_before) / kStep;
    given_before = now;
  }
  double ahead() const { return (given_before - q[0]) / kStep; }
};

EvenMotion& fresh() {
  static std::optional<EvenMotion> motion;
  motion.emplace().start();
  return *motion;
}

// Proves URH-22.

/// The set-points pause for n cycles and then resume where they were.
void after_a_stall_the_target_slows_down_and_never_goes_back(void**) {
  for (const int missed : {1, 2, 3, 7, 12}) {
    EvenMotion& motion = fresh();
    ASSERT_NEAR(motion.ahead(), 0.0, 1e-6);
    double slowest = 1.0, hardest = 0.0;
    for (int k = 0; k < missed + 30; ++k) {
      motion.tick(k < missed ? 0 : 1);
      slowest = std::min(slowest, motion.way);
      hardest = std::max(hardest, std::abs(motion.way - motion.way_before));
      if (k < missed) assert_true(motion.ahead() <= k + 1);
    }
    assert_true(motion.bench.running());
    const double fading = 1.0 - (missed + 1) * (missed + 1) / 169.0;  // slowest while it fades
    assert_true(slowest > std::min(1.0 - 1.5 * missed / 12.0, fading) - 1e-6 || missed > 7);
    assert_true(slowest > -1e-6);
    assert_true(hardest < 6.0 * missed / 144.0 + (missed + 1) * (missed + 1) / 169.0);
    ASSERT_NEAR(motion.ahead(), 0.0, 1e-6);
  }
}

/// The arm is to stop: it moves back by at most an eighth of the lead in a cycle.
void after_a_stall_that_ends_in_a_halt_the_way_back_is_slow(void**) {
  EvenMotion& motion = fresh();
  for (int k = 0; k < 3; ++k) motion.tick(0);
  double fastest = 0.0;
  for (int k = 0; k < 30; ++k) {
    motion.bench.set(motion.q);
    motion.tick(0);
    fastest = std::min(fastest, motion.way);
  }
  assert_true(fastest < -0.4 && fastest > -4.0 / 8.0);
  ASSERT_NEAR(motion.ahead(), 0.0, 1e-6);
}

void stalls_in_a_row_do_not_add_up(void**) {
  EvenMotion& motion = fresh();
  for (int k = 0; k < 300; ++k) {
    motion.tick(k % 2 == 0 ? 0 : 2);
    assert_true(motion.way > 0.9 && motion.way < 1.1);
    if (k % 2 == 1) assert_true(std::abs(motion.ahead()) < 0.5);
  }
  for (int k = 0; k < 300; ++k) {  // the computer misses one cycle of ten
    motion.tick(k % 10 == 0 ? 0 : 1);
    assert_true(motion.way > 0.6);
    assert_true(motion.ahead() < 1.2);
  }
  for (int k = 0; k < 300; ++k) {  // one of four: the previous offset has not faded out yet
    motion.tick(k % 4 == 0 ? 0 : 1);
    assert_true(motion.way > 0.5 && motion.ahead() < 4.5);
    assert_true(std::abs(motion.way - motion.way_before) < 0.4);
  }
}

/// Acceleration of the robot's joint target when the program's target jumps by one cycle's way.
double hardest_of_a_jump() {
  double weight = 0.0, unit_speed = 0.0;
  ServoLaw{2000.0, 0.03}.step(1.0, kCycle_s, weight, unit_speed);
  return unit_speed / kCycle_s * EvenMotion::kStep;
}

/// At a constant speed, `n` extra set-points arrive in one cycle and none in the `n` cycles before
/// or after it; the program spreads the jump over several cycles.
void set_points_in_a_lump_are_no_jump(void**) {
  for (const bool early : {true, false}) {
    for (int n = 1; n <= 5; ++n) {
      EvenMotion& motion = fresh();
      double fastest = 0.0, hardest = 0.0;
      for (int k = 0; k < 40; ++k) {
        motion.tick(k == (early ? 0 : n) ? n + 1 : k <= n ? 0 : 1);
        fastest = std::max(fastest, motion.way);
        hardest = std::max(hardest, std::abs(motion.acceleration));
      }
      print_message("    %d set-points in one cycle, %s: %.2f rad/s^2\n", n + 1,
                    early ? "early" : "late", hardest);
      assert_true(motion.bench.running());
      assert_true(fastest <= 1.0 + n / 8.0);
      assert_true(hardest < n * hardest_of_a_jump() / 5.0);
      ASSERT_NEAR(motion.ahead(), 0.0, 1e-6);
    }
  }
}

/// The second lump arrives before the first has faded out.
void lumps_in_a_row_are_no_jumps_either(void**) {
  EvenMotion& motion = fresh();
  double hardest = 0.0;
  for (int k = 0; k < 60; ++k) {
    const int phase = k % 4;
    motion.tick(k >= 8 ? 1 : phase == 0 ? 2 : phase == 1 ? 0 : 1);
    hardest = std::max(hardest, std::abs(motion.acceleration));
  }
  assert_true(hardest < hardest_of_a_jump() / 5.0);
  ASSERT_NEAR(motion.ahead(), 0.0, 1e-6);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(after_a_stall_the_target_slows_down_and_never_goes_back),
      cmocka_unit_test(after_a_stall_that_ends_in_a_halt_the_way_back_is_slow),
      cmocka_unit_test(stalls_in_a_row_do_not_add_up),
      cmocka_unit_test(set_points_in_a_lump_are_no_jump),
      cmocka_unit_test(lumps_in_a_row_are_no_jumps_either),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
