// Tests the text that the HAL uploads, interpreted by the controller: set-points through registers,
// and the target passed to servoj when the control computer pauses for some cycles and then
// resumes.
#include <optional>

#include "tests/ur/programs/ur_servo_bench.hpp"

namespace tactus::ur {
namespace {

/// Largest change of the target speed from one cycle to the next while `step` runs, rad/s^2.
template <class Step>
double hardest(ServoBench& bench, int cycles, Step&& step) {
  double worst = 0.0, before = bench.image().target_qd[0];
  for (int k = 0; k < cycles; ++k) {
    step(k);
    bench.tick();
    worst = std::max(worst, std::abs(bench.image().target_qd[0] - before) / kCycle_s);
    before = bench.image().target_qd[0];
  }
  return worst;
}

// Proves URP-11.

void the_arm_follows_the_set_points_late_by_the_lookahead(void**) {
  static ServoBench bench;
  bench.start();
  for (int k = 0; k < 500; ++k) {
    bench.set_next();
    bench.tick();
    assert_int_equal(bench.echo(), bench.count);
    // A second-order law lags a slow sine by its lookahead, 0.03 s.
    if (k > 50) ASSERT_NEAR(bench.target()[0], ServoBench::path(bench.time_s - 0.03)[0], 0.005);
  }
  assert_true(bench.running());
}

void it_waits_for_the_first_set_point(void**) {
  static ServoBench bench;
  bench.start();
  const Joints q = bench.target();
  bench.run(120);
  assert_true(bench.running());
  assert_joints(bench.target(), q, 0.0);
}

/// The program that uploaded it may be gone.
void without_a_first_set_point_it_ends_after_a_second(void**) {
  static ServoBench bench;
  bench.start();
  const Joints q = bench.target();
  bench.run(130);
  assert_false(bench.running());
  assert_int_equal(bench.echo(), kServoEnded);
  assert_joints(bench.target(), q, 0.0);
}

void a_first_set_point_elsewhere_ends_it_where_the_arm_is(void**) {
  static ServoBench bench;
  bench.start();
  const Joints q = bench.target();
  bench.set(q + Joints::Constant(0.02));
  bench.run(10);
  assert_true(bench.stopped_safely());
  assert_joints(bench.target(), q, 0.0);
  assert_int_equal(bench.echo(), kServoEnded);
}

void one_late_set_point_is_bridged(void**) {
  static ServoBench bench;
  bench.start();
  const auto steady = [&](int) { bench.set_next(); };
  hardest(bench, 200, steady);
  const double usual = hardest(bench, 100, steady);
  bench.time_s += kCycle_s;  // this one does not arrive
  const double late = hardest(bench, 1, [](int) {});
  const double after = hardest(bench, 20, steady);
  // At 0.6 rad/s at most (1 + 4) / 169 of a cycle's way is missing: gain times 0.6 * 0.008 * that.
  const double fade = 2000.0 * 0.6 * kCycle_s * 5.0 / 169.0;
  assert_true(late <= usual + fade && after <= usual + fade);
  assert_true(bench.running());
}

void silence_fades_out_and_ends_in_a_stop(void**) {
  static ServoBench bench;
  bench.start();
  hardest(bench, 98, [&](int) { bench.set_next(); });  // at its fastest
  const double speed = bench.image().target_qd[0];
  assert_true(speed > 0.55);
  const std::int32_t last = bench.count;
  for (int k = 0; k < 12; ++k) {
    bench.tick();
    assert_true(bench.running());
    assert_int_equal(bench.echo(), last);
  }
  assert_in_range(bench.run_to_end(100), 1, 40);
  bench.run(1);
  assert_true(bench.stopped_safely());
  assert_int_equal(bench.echo(), kServoEnded);
  ASSERT_NEAR(bench.image().target_qd[0], 0.0, 0.0);
  // The fading over 13 cycles, the lookahead and the stop limit the remaining way.
  const double way = bench.target()[0] - ServoBench::path(bench.time_s)[0];
  assert_true(way > 0.0 && way < speed * (2.0 / 3.0 * 13 * kCycle_s + 0.03));
}

void patience_is_counted_in_cycles(void**) {
  static ServoBench bench;
  ServoProgram script;
  script.patience = 3;
  bench.start(script);
  hardest(bench, 98, [&](int) { bench.set_next(); });
  bench.run(3);
  assert_true(bench.echo() > 0);
  assert_in_range(bench.run_to_end(100), 1, 40);
}

void a_negative_count_ends_it_with_a_stop(void**) {
  static ServoBench bench;
  bench.start();
  hardest(bench, 98, [&](int) { bench.set_next(); });
  bench.machine().io.input.ints[kFirst] = -1;
  const double braking = hardest(bench, 60, [](int) {});
  assert_true(bench.stopped_safely());
  assert_true(braking <= 4.0 + 1e-6);
}

void none_in_one_cycle_and_two_in_the_next_are_smooth(void**) {
  static ServoBench bench;
  bench.start();
  const double usual = hardest(bench, 400, [&](int) { bench.set_next(); });
  const double worst = hardest(bench, 400, [&](int k) {
    if (k % 2 == 0) return;
    bench.time_s += kCycle_s;
    ++bench.count;
    bench.set_next();
  });
  assert_true(bench.running());
  // The fading shortens one cycle's way as above, and the next set-point restores it.
  assert_true(worst <= usual + 2.0 * 2000.0 * 0.6 * kCycle_s / 13.0);
}

void tool_payload_and_zeroing_are_in_the_text(void**) {
  static ServoBench bench;
  ServoProgram script;
  script.tcp << 0.01, -0.02, 0.3, 0.0, 1.5, 1e-7;
  script.payload_kg = 2.5;
  script.payload_com = {0.001, 0.002, 0.06};
  script.zero_force = true;
  bench.start(script);
  assert_joints(bench.machine().tcp_offset, script.tcp, 1e-9);
  ASSERT_NEAR(bench.machine().payload, 2.5, 0.0);
  ASSERT_NEAR(bench.machine().payload_cog[2], 0.06, 1e-12);
  const std::string_view text(bench.text.data(), bench.text.size());
  assert_true(text.find("zero_ftsensor()") != std::string_view::npos);
  assert_false(bench.said.has("not emulated"));
}

// Proves URH-32.
void what_is_left_to_the_controller_is_not_in_the_text(void**) {
  static ServoProgramText text;
  const auto has = [](const ServoProgram& script, std::string_view call) {
    return write_servo_program(script, text).find(call) != std::string_view::npos;
  };
  ServoProgram script;
  assert_true(has(script, "set_tcp(") && has(script, "set_payload("));
  script.sets_tcp = false;
  assert_true(!has(script, "set_tcp(") && has(script, "set_payload("));
  script.sets_payload = false;
  assert_true(!has(script, "set_tcp(") && !has(script, "set_payload("));
  static ServoBench bench;
  bench.start(script);  // and it runs
}

// Proves URP-11.
void a_value_out_of_range_writes_no_text(void**) {
  static ServoProgramText text;
  ServoProgram script;
  script.gain = 2001.0;
  assert_int_equal(write_servo_program(script, text).size(), 0);
  script = {};
  script.tcp[3] = std::nan("");
  assert_int_equal(write_servo_program(script, text).size(), 0);
  script = {};
  script.patience = 0;
  assert_int_equal(write_servo_program(script, text).size(), 0);
  script = {};
  script.period_s = std::nan("");
  assert_int_equal(write_servo_program(script, text).size(), 0);
}

void every_setting_is_filled_in_and_every_line_ends(void**) {
  static ServoProgramText text;
  const std::string_view program = write_servo_program({}, text);
  assert_true(program.find('@') == std::string_view::npos);
  assert_true(program.substr(program.size() - 5) == "\nend\n");
  assert_true(program.substr(0, 18) == "def tactus_servo()");
}

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
}  // namespace tactus::ur

int main() {
  using namespace tactus::ur;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_arm_follows_the_set_points_late_by_the_lookahead),
      cmocka_unit_test(it_waits_for_the_first_set_point),
      cmocka_unit_test(without_a_first_set_point_it_ends_after_a_second),
      cmocka_unit_test(a_first_set_point_elsewhere_ends_it_where_the_arm_is),
      cmocka_unit_test(one_late_set_point_is_bridged),
      cmocka_unit_test(silence_fades_out_and_ends_in_a_stop),
      cmocka_unit_test(patience_is_counted_in_cycles),
      cmocka_unit_test(a_negative_count_ends_it_with_a_stop),
      cmocka_unit_test(none_in_one_cycle_and_two_in_the_next_are_smooth),
      cmocka_unit_test(tool_payload_and_zeroing_are_in_the_text),
      cmocka_unit_test(what_is_left_to_the_controller_is_not_in_the_text),
      cmocka_unit_test(a_value_out_of_range_writes_no_text),
      cmocka_unit_test(every_setting_is_filled_in_and_every_line_ends),
      cmocka_unit_test(after_a_stall_the_target_slows_down_and_never_goes_back),
      cmocka_unit_test(after_a_stall_that_ends_in_a_halt_the_way_back_is_slow),
      cmocka_unit_test(stalls_in_a_row_do_not_add_up),
      cmocka_unit_test(set_points_in_a_lump_are_no_jump),
      cmocka_unit_test(lumps_in_a_row_are_no_jumps_either),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
