// Tests the motion commands of the emulated controller against integration in small steps, closed
// forms and published positions.
#include "tests/ur/controller/ur_path_bench.hpp"

namespace tactus::ur {
namespace {

/// Returns the number of cycles until the command has finished.
int run(Motion& motion, double h_s = 0.008) {
  int cycles = 0;
  for (; motion.busy() && cycles < 10000; ++cycles) motion.advance(h_s);
  return cycles;
}

// Proves URE-10.

void forward_kinematics_gives_the_published_positions(void**) {
  const struct {
    Joints q;
    Vector3 p;
  } kRows[] = {{joints(0, 0, 0, 0, 0, 0), {-1.1843, -0.256141, 0.0116}},
               {joints(0, -1.2, 1.2, -0.1, 1.57, 0), {-0.897353027, -0.164014421, 0.591790577}},
               {joints(0.3, -1.1, 1.4, -0.7, 0.9, -0.4), {-0.828730943, -0.487953914, 0.425150793}},
               {joints(-1.6, -1.727, -2.203, -0.808, 1.595, -0.031),
                {-0.179509850, -0.606984887, 0.230850132}}};
  for (const auto& row : kRows)
    assert_true((forward(row.q).p - row.p).cwiseAbs().maxCoeff() < 1e-9);
  const Vector6 pose = forward(kRows[2].q).pose();
  ASSERT_NEAR(pose[3], 1.330753, 1e-6);
  ASSERT_NEAR(pose[4], 0.064841, 1e-6);
  ASSERT_NEAR(pose[5], -1.043399, 1e-6);
}

void inverse_kinematics_finds_the_posture_next_to_the_arm(void**) {
  const Joints q = joints(0.3, -1.1, 1.4, -0.7, 0.9, -0.4);
  const Frame tool = Frame::of(joints(0.01, 0.02, 0.1, 0.1, 0, 0));
  Joints found;
  assert_true(inverse(forward(q) * tool, tool, q + Joints::Constant(0.1), found));
  assert_true((found - q).cwiseAbs().maxCoeff() < 1e-7);
  Frame far;
  far.p << 3.0, 0.0, 0.0;
  assert_false(inverse(far, tool, q, found));
}

// Proves URE-11.

/// ddq = g (c - q - L dq) in steps of 1 us.
void integrate(double g, double L, double c, double h_s, double& q, double& dq) {
  const int steps = static_cast<int>(h_s * 1e6 + 0.5);
  for (int i = 0; i < steps; ++i) {
    const double h = 1e-6, a = g * (c - q - L * dq);
    const double q_mid = q + 0.5 * h * dq, dq_mid = dq + 0.5 * h * a;
    q += h * dq_mid;
    dq += h * g * (c - q_mid - L * dq_mid);
  }
}

void servoj_is_a_pull_towards_the_projected_position(void**) {
  for (const ServoLaw law : {ServoLaw{300.0, 0.1}, ServoLaw{2000.0, 0.03}, ServoLaw{2000.0, 0.2},
                             ServoLaw{400.0, 0.1}}) {
    Motion motion;
    const Joints home = joints(0.3, -1.1, 1.4, -0.7, 0.9, -0.4);
    motion.rest(home);
    double q = home[3], dq = 0.0;
    for (int k = 1; k <= 100; ++k) {
      Joints target = home;
      target[3] += k < 50 ? 0.004 * k : 0.2;  // half a radian per second, and then none
      motion.servo_j(target, 0.008, law);
      motion.advance(0.008);
      integrate(law.gain, law.lookahead_s, target[3], 0.008, q, dq);
      ASSERT_NEAR(motion.q()[3], q, 1e-6);
      ASSERT_NEAR(motion.dq()[3], dq, 1e-4);
    }
    assert_false(static_cast<bool>(motion.take_fault()));
  }
}

void behind_a_ramp_servoj_is_late_by_the_lookahead_time(void**) {
  Motion motion;
  motion.rest(Joints::Zero());
  constexpr double kSpeed = 0.3;
  double target = 0.0;
  for (int k = 1; k <= 250; ++k) {
    target = kSpeed * k * 0.008;
    motion.servo_j(Joints::Constant(target), 0.008, {300.0, 0.1});
    motion.advance(0.008);
  }
  // The set-point is held for a cycle: on average it is half a cycle behind the ramp.
  ASSERT_NEAR(target - motion.q()[0], kSpeed * (0.1 - 0.004), 0.002 * kSpeed);
}

// Proves URE-12.

void movej_takes_the_time_of_its_trapezoid(void**) {
  Motion motion;
  motion.rest(joints(-1.57, -1.57, 0, 0, 0, 0));
  const Joints goal = joints(-1.57, -1.6, 1.6, -0.7, 0.7, 0.2);
  assert_true(motion.move_j(goal, 3.4, 3.1, 0.0));
  const double took_s = run(motion) * 0.008;
  assert_true(took_s > 1.4 && took_s < 2.0);  // 2 sqrt(1.6 / 3.4) and the settling time
  assert_true(motion.q() == goal && motion.dq().isZero(0.0));
  assert_true(motion.move_j(joints(-1.57, -1.57, 0, 0, 0, 0), 3.4, 3.1, 3.0));
  assert_true(run(motion) * 0.008 >= 3.0);
  assert_false(motion.move_j(joints(-123, 0, 0, 0, 0, 0), 1.4, 1.0, 0.0));
  assert_false(motion.busy());
}

void no_joint_is_faster_than_it_can_be(void**) {
  Motion motion;
  const Joints most = MotionLimits().speed;
  motion.rest(joints(-1.57, -1.6, 1.6, -0.7, 0.7, 0.2));
  assert_true(motion.move_j(joints(1.57, -1.6, 1.6, -0.7, 0.7, 0.2), 1.4, 1.4, 0.1));
  Joints before = motion.q();
  while (motion.busy()) {
    motion.advance(0.008);
    assert_true(((motion.q() - before).cwiseAbs().array() <= 0.008 * most.array() * 1.0001).all());
    before = motion.q();
  }
}

void a_move_begins_when_the_arm_stands(void**) {
  Motion motion;
  motion.rest(Joints::Zero());
  motion.speed_j(Joints::Constant(0.4), 40.0, 0.1);
  run(motion);
  assert_true(motion.move_j(Joints::Zero(), 1.4, 1.05, 0.0));
  double before = motion.dq()[0];
  while (motion.busy()) {
    motion.advance(0.008);
    assert_true(std::abs(motion.dq()[0] - before) < 0.008 * 4.01);
    before = motion.dq()[0];
  }
  assert_true(motion.q().isZero(0.0));
}

void movel_keeps_the_line(void**) {
  Motion motion;
  motion.rest(joints(-1.57, -1.6, 1.6, -0.7, 0.7, 0.2));
  const Frame from = forward(motion.q());
  Frame to = from;
  to.p += Vector3(0.1, -0.1, 0.15);
  assert_true(motion.move_l(to, 1.2, 0.25, 0.0));
  const Vector3 line = (to.p - from.p).normalized();
  while (motion.busy()) {
    motion.advance(0.008);
    const Vector3 way = forward(motion.q()).p - from.p;
    assert_true((way - way.dot(line) * line).norm() < 1e-6);
  }
  assert_true((forward(motion.q()).p - to.p).norm() < 1e-7);
  to.p = Vector3(-10.0, 0.0, 0.0);
  assert_false(motion.move_l(to, 1.2, 0.25, 0.0));
}

void speedj_ramps_on_the_leading_axis_and_stopj_to_rest(void**) {
  Motion motion;
  motion.rest(Joints::Zero());
  motion.speed_j(joints(0.4, -0.2, 0, 0, 0, 0), 2.0, 1.0);
  for (int k = 1; k <= 125; ++k) {
    motion.advance(0.008);
    const double t = k * 0.008, v = t < 0.2 ? 2.0 * t : 0.4;
    const double way = t < 0.2 ? t * t : 0.04 + 0.4 * (t - 0.2);
    ASSERT_NEAR(motion.dq()[0], v, 1e-9);
    ASSERT_NEAR(motion.q()[0], way, 1e-9);
    ASSERT_NEAR(motion.q()[1], -0.5 * way, 1e-9);
  }
  assert_false(motion.busy());
  motion.idle(0.008, true);
  assert_false(static_cast<bool>(motion.take_fault()));  // held until the next command
  motion.stop_j(4.0);
  ASSERT_NEAR(run(motion), 0.1 / 0.008, 1.0);
  assert_true(motion.resting());
}

// Proves URE-20.

void faults_of_the_path_are_told_apart(void**) {
  Motion motion;
  motion.rest(Joints::Zero());
  motion.servo_j(Joints::Constant(0.7), 0.008, {});
  Stop stop = motion.take_fault();
  assert_true(stop.code == Code::kPathSanity && stop.argument == kSuddenChange);
  for (int k = 1; k < 50; ++k) {
    motion.servo_j(Joints::Constant(0.005 * k), 0.008, {2000.0, 0.03});
    motion.advance(0.008);
  }
  motion.idle(0.008, true);  // the script is late
  stop = motion.take_fault();
  assert_true(stop.code == Code::kPathSanity && stop.argument == kSuddenStop);
  motion.servo_j(Joints::Constant(std::nan("")), 0.008, {});
  stop = motion.take_fault();
  assert_true(stop.code == Code::kPathSanity && stop.argument == kInvalidSetPoint);
}

}  // namespace
}  // namespace tactus::ur

int main() {
  using namespace tactus::ur;
  const CMUnitTest tests[] = {
      cmocka_unit_test(forward_kinematics_gives_the_published_positions),
      cmocka_unit_test(inverse_kinematics_finds_the_posture_next_to_the_arm),
      cmocka_unit_test(servoj_is_a_pull_towards_the_projected_position),
      cmocka_unit_test(behind_a_ramp_servoj_is_late_by_the_lookahead_time),
      cmocka_unit_test(movej_takes_the_time_of_its_trapezoid),
      cmocka_unit_test(no_joint_is_faster_than_it_can_be),
      cmocka_unit_test(a_move_begins_when_the_arm_stands),
      cmocka_unit_test(movel_keeps_the_line),
      cmocka_unit_test(speedj_ramps_on_the_leading_axis_and_stopj_to_rest),
      cmocka_unit_test(faults_of_the_path_are_told_apart),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
