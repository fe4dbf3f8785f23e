// Cartesian pose control with a servo that lags and a measurement that is late, as on a real robot:
// the arm comes to rest for any target within reach, at its edge or beyond.
#include "kernel/model/link_frames.hpp"
#include "sim_plant/arm/plant_params.hpp"
#include "tests/control/pose_bench.hpp"
#include "tests/oracles/published.hpp"
#include "tests/support/testing.hpp"
#include "tests/support/trials.hpp"

namespace tactus {
namespace {

constexpr double kAtRest_rad_s = 0.01;  // rest_velocity of [executive]

/// A servo of second order, critically damped: T^2 ddq + 2 T dq + q = q_c, solved exactly for a
/// command that is held for a period; ideal with T = 0.
struct LaggingServo {
  double time_constant_s;
  JointVector q, dq = JointVector::Zero();

  void move(const JointVector& q_c, double dt_s) {
    const double T = time_constant_s;
    if (T == 0.0) {
      dq = (q_c - q) / dt_s;
      q = q_c;
      return;
    }
    const JointVector from = q - q_c, slope = dq + from / T;
    const double left = std::exp(-dt_s / T);
    q = q_c + left * (from + dt_s * slope);
    dq = left * (dq - dt_s / T * slope);
  }
};

struct Loop {
  static constexpr int kMostDelay = 4;
  double dt_s;
  int delay;
  LaggingServo servo;
  std::array<JointVector, kMostDelay + 1> past;
  Pose x_d, x;
  JointVector q;
  Jacobian J;
  CartesianPose law;

  Loop(double time_constant_s, int delay_cycles, double period_s)
      : dt_s(period_s), delay(delay_cycles), servo{time_constant_s, ready_pose()} {
    past.fill(servo.q);
    law.x_d.source = &x_d;
    law.x.source = &x;
    law.J.source = &J;
    law.q.source = &q;
    measure();
    x_d = x;
    ASSERT_OK(law.start(dt_s));
  }
  void measure() {
    q = past[static_cast<std::size_t>(delay)];
    x = tip_at(q, J);
  }
  /// Steps one period; returns the largest joint velocity, rad/s.
  double step() {
    measure();
    ASSERT_OK(law.step(dt_s));
    servo.move(law.q_c.value, dt_s);
    for (std::size_t i = past.size(); --i > 0;) past[i] = past[i - 1];
    past[0] = servo.q;
    return servo.dq.cwiseAbs().maxCoeff();
  }
};

/// Targets seen from the axis of joint 1, at the height of the shoulder: straight out to the edge
/// of reach and beyond, up, down, to the side, and on the other side of the base, past the
/// shoulder.
constexpr int kTargets = 12, kAtOnce = tries(kTargets, 4);
Vector3 target(int number, const Vector3& tip) {
  const double reach = published().reach;
  const double height = link_frames<Robot>(joint_trig<Robot>(JointVector::Zero()))[2].p.z();
  const Vector3 out = Vector3(tip.x(), tip.y(), 0.0).normalized(), up = Vector3::UnitZ();
  const Vector3 side(-out.y(), out.x(), 0.0);
  const Vector3 ways[kTargets] = {0.97 * out,
                                  out,
                                  1.1 * out,
                                  2.0 * out,
                                  up,
                                  1.3 * up,
                                  side,
                                  1.3 * side + 0.3 * up,
                                  -0.6 * out + 0.2 * up,
                                  -1.2 * out,
                                  0.2 * out - 1.2 * up,
                                  0.2 * up};
  return height * up + reach * ways[number];
}

// Proves CP-11.

void whatever_the_target_the_arm_ends_at_rest_with_any_lag_and_delay(void**) {
  int number = 0;
  for (const double time_constant_s : {0.0, 5e-3, 20e-3, 100e-3})
    for (const double dt_s : {1e-3, 2e-3, 8e-3})
      for (int delay = 0; delay <= Loop::kMostDelay; delay += dt_s > 1e-3 ? 1 : 2) {
        // All targets at the longest period, where the delays are longest; else one after the
        // other.
        for (int i = 0; i < (dt_s > 4e-3 && delay % 4 == 0 ? kAtOnce : 1); ++i, ++number) {
          Loop loop(time_constant_s, delay, dt_s);
          loop.x_d.p = target(number % kTargets, loop.x.p);
          constexpr double kTime_s = 60.0, kRest_s = 2.0;
          double fastest = 0.0;
          for (int k = 0; k * dt_s < kTime_s; ++k) {
            const double speed = loop.step();
            if (k * dt_s > kTime_s - kRest_s) fastest = std::max(fastest, speed);
          }
          if (!(fastest < kAtRest_rad_s))
            print_error("target %d, servo %g ms, %d cycles of %g ms late: %.3g rad/s\n",
                        number % kTargets, 1e3 * time_constant_s, delay, 1e3 * dt_s, fastest);
          assert_true(fastest < kAtRest_rad_s);
        }
      }
}

/// Within reach the lag does not change the place where the arm ends.
void a_target_in_reach_is_reached_with_any_lag_and_delay(void**) {
  for (const double time_constant_s : {0.0, 20e-3, 100e-3})
    for (const int delay : {0, Loop::kMostDelay}) {
      Loop loop(time_constant_s, delay, 8e-3);
      loop.x_d.p += Vector3(-0.1, 0.1, 0.1);
      loop.x_d.r = exp_so3({0.1, -0.2, 0.1}) * loop.x_d.r;
      for (int k = 0; k < 2500; ++k) static_cast<void>(loop.step());
      ASSERT_NEAR((loop.x_d.p - loop.x.p).norm(), 0.0, 1e-4);
      ASSERT_NEAR(log_so3(loop.x_d.r * loop.x.r.conjugate()).norm(), 0.0, 1e-3);
    }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(whatever_the_target_the_arm_ends_at_rest_with_any_lag_and_delay),
      cmocka_unit_test(a_target_in_reach_is_reached_with_any_lag_and_delay),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
