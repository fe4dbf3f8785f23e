// The commanded twist against differences of the commanded pose: desired poses at rest, moving and
// turning, both compliant frames, with and without a push.
#include <array>

#include "kernel/control/admittance.hpp"
#include "kernel/math/sincos.hpp"
#include "tests/support/rotation_cases.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr double kPeriod_s = 1e-3;

/// A smooth motion: a circle, and turns about two axes one after the other.
struct Motion {
  double rate;
  Pose pose(double t) const {
    const SinCos a = sincos(rate * t);
    const Vector3 p(0.4 + 0.1 * a.cos, 0.1 * a.sin, 0.5 + 0.03 * rate * t);
    return {p, exp_so3(0.9 * a.sin * kFirst) * exp_so3(rate * t * kSecond)};
  }
  Vector6 twist(double t) const {
    const SinCos a = sincos(rate * t);
    Vector6 v;
    v << rate * Vector3(-0.1 * a.sin, 0.1 * a.cos, 0.03),
        0.9 * rate * a.cos * kFirst + exp_so3(0.9 * a.sin * kFirst) * (rate * kSecond);
    return v;
  }
  inline static const Vector3 kFirst = {0.6, 0.0, 0.8}, kSecond = {0.0, -0.28, 0.96};
};

struct Bench {
  Pose x_d;
  Vector6 v_d, h = Vector6::Zero();
  Admittance ac;
  explicit Bench(CompliantFrame frame) {
    Admittance::Params& p = ac.params;
    p.frame = frame;
    p.mass = {2.0, 1.0, 0.5};
    p.inertia = {0.2, 0.1, 0.3};
    p.stiffness = {100.0, 300.0, 0.0};
    p.damping = {40.0, 0.0, 30.0};
    p.rotational_stiffness = {4.0, 1.0, 2.0};
    p.rotational_damping = {1.0, 3.0, 0.2};
    p.max_displacement = 1.0;
    p.max_rotation = 1.8;
    p.max_velocity = 2.0;
    p.max_angular_velocity = 10.0;
    ac.x_d.source = &x_d;
    ac.v_d.source = &v_d;
    ac.h.source = &h;
  }
};

/// Returns the wrench of an interval of half a second: random, and zero every third time.
Vector6 push(RandomVectors& random, int interval) {
  Vector6 h;
  h << 20.0 * random.vector(), 2.0 * random.vector();
  return interval % 3 == 2 ? Vector6(Vector6::Zero()) : h;
}

/// Returns the twist at the middle of nine poses one period apart, by differences of eighth order.
Vector6 difference(const std::array<Pose, 9>& poses) {
  const auto at = [&](double h) { return static_cast<std::size_t>(std::lround(h) + 4); };
  Vector6 v;
  v.head<3>() = first_derivative([&](double h) { return poses[at(h)].p; }, 1.0) / kPeriod_s;
  const Eigen::Quaterniond rate(Eigen::Vector4d(
      first_derivative([&](double h) { return poses[at(h)].r.coeffs(); }, 1.0) / kPeriod_s));
  v.tail<3>() = 2.0 * (rate * poses[4].r.conjugate()).vec();  // in base axes
  return v;
}

/// Runs three seconds and compares where the wrench is constant over nine poses.
void compare(CompliantFrame frame, const Motion& motion) {
  Bench bench(frame);
  RandomVectors random;
  std::array<Pose, 9> poses;
  std::array<Vector6, 9> twists;
  bench.x_d = motion.pose(0.0);
  bench.v_d = motion.twist(0.0);
  ASSERT_OK(bench.ac.start());
  double largest_turn = 0.0, worst = 0.0;
  for (int i = 0; i < 3000; ++i) {
    if (i % 500 == 0) bench.h = push(random, i / 500);
    if (frame == CompliantFrame::kDesired && motion.rate != 0.0) {
      // The force is constant in the compliant frame's axes, so that the motion is smooth.
      bench.h.head<3>() = motion.pose(i * kPeriod_s).r * Vector3(10.0, -20.0, 5.0);
      bench.h.tail<3>() = motion.pose(i * kPeriod_s).r * Vector3(2.0, 1.0, -1.0);
    }
    bench.x_d = motion.pose(i * kPeriod_s);
    bench.v_d = motion.twist(i * kPeriod_s);
    ASSERT_OK(bench.ac.step(kPeriod_s));
    assert_false(bench.ac.limited.value);
    poses[static_cast<std::size_t>(i % 500 % 9)] = bench.ac.x_c.value;
    twists[static_cast<std::size_t>(i % 500 % 9)] = bench.ac.v_c.value;
    if (i % 500 % 9 != 8) continue;
    worst = std::max(worst, (difference(poses) - twists[4]).cwiseAbs().maxCoeff());
    const Eigen::Quaterniond turn = bench.ac.x_c.value.r * bench.x_d.r.conjugate();
    largest_turn = std::max(largest_turn, log_so3(turn).norm());
  }
  print_message("frame %d, rate %g: turned %.2f rad, worst %.1e\n", static_cast<int>(frame),
                motion.rate, largest_turn, worst);
  assert_true(largest_turn > 0.5);
  assert_true(worst < 1e-6);
}

// Proves AD-3.

void over_a_pose_that_stands_the_twist_is_the_derivative_of_the_pose(void**) {
  for (const CompliantFrame frame : {CompliantFrame::kDesired, CompliantFrame::kBase})
    compare(frame, {0.0});
}

void over_a_pose_that_moves_and_turns_it_is_too(void**) {
  for (const CompliantFrame frame : {CompliantFrame::kDesired, CompliantFrame::kBase})
    for (const double rate : {0.4, 2.0}) compare(frame, {rate});
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(over_a_pose_that_stands_the_twist_is_the_derivative_of_the_pose),
      cmocka_unit_test(over_a_pose_that_moves_and_turns_it_is_too),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
