// Monotone interpolation: the motion between two waypoints stays between them.
#include "kernel/reference/motion/monotone.hpp"

#include "kernel/math/so3.hpp"
#include "kernel/reference/space/task_space.hpp"
#include "tests/reference/generator/reference_bench.hpp"
#include "tests/support/testing.hpp"

namespace {

using namespace tactus;

constexpr int kWaypoints = ReferenceBench::kWaypoints;

/// Returns the joints `t` seconds after the beginning of the segment that ends at waypoint `index`.
JointSpace::Point at(const Trajectory<JointSpace>& motion, int index, double t) {
  return motion.segment(index, {}).at(t);
}

/// Returns a random trajectory with small and large steps, some of them zero, and these fields.
Trajectory<JointSpace>& random_motion(ReferenceBench& bench, Random& random, Fields fields) {
  Trajectory<JointSpace>& motion = *bench.trajectory(fields);
  motion.interpolation = Interpolation::kMonotone;
  double time_s = 0.0;
  for (int i = 0; i < kWaypoints; ++i) {
    bench.add(motion, time_s, 0.0);
    JointSpace::Point& point = motion.waypoints[i].point;
    for (int j = 0; j < kDof; ++j) {
      const bool flat = i > 0 && random.below(4) == 0;
      point.q[j] = flat ? motion.waypoints[i - 1].point.q[j] : random.uniform(-3.0, 3.0);
      point.dq[j] = random.uniform(-9.0, 9.0);
    }
    time_s += random.uniform(0.01, 2.0);
  }
  return motion;
}

double angle_between(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  return log_so3(a.conjugate() * b).norm();
}

// Proves RG-18.

void between_two_waypoints_no_joint_goes_beyond_either(void**) {
  static ReferenceBench bench;
  Random random{8};
  for (int trial = 0; trial < 40; ++trial) {
    const Fields fields = trial % 2 == 0 ? 0 : kVelocityField;
    const Trajectory<JointSpace>& motion = random_motion(bench, random, fields);
    make_monotone(motion);
    for (int i = 1; i < kWaypoints; ++i) {
      const JointVector &from = motion.at(i - 1).point.q, &to = motion.at(i).point.q;
      const double T = motion.at(i).time_s - motion.at(i - 1).time_s;
      for (int k = 0; k <= 50; ++k) {
        const JointVector q = at(motion, i, T * k / 50).q;
        assert_true(((q - from.cwiseMax(to)).array() <= 1e-12).all());
        assert_true(((from.cwiseMin(to) - q).array() <= 1e-12).all());
      }
    }
  }
}

void velocity_stays_continuous(void**) {
  static ReferenceBench bench;
  Random random{9};
  const Trajectory<JointSpace>& motion = random_motion(bench, random, 0);
  make_monotone(motion);
  for (int i = 1; i + 1 < kWaypoints; ++i) {
    const double T = motion.at(i).time_s - motion.at(i - 1).time_s;
    ASSERT_NEAR((at(motion, i, T).dq - at(motion, i + 1, 0.0).dq).norm(), 0.0, 1e-9);
  }
}

/// Slopes 1 and 3 have the harmonic mean 3/2 over equal times, and over times 1 and 2, with the
/// weights 5 and 4, the mean 9 / (5 / 1 + 4 / 3) = 27/19. Slopes of different sign have none.
void velocities_are_the_weighted_harmonic_means_of_the_secants(void**) {
  static ReferenceBench bench;
  const struct {
    double t2, q2, expected;
  } cases[] = {{2.0, 4.0, 1.5}, {3.0, 7.0, 27.0 / 19.0}, {2.0, 0.5, 0.0}};
  for (const auto& c : cases) {
    Trajectory<JointSpace>& motion = *bench.trajectory(0);
    bench.add(motion, 0.0, 0.0);
    bench.add(motion, 1.0, 1.0);
    bench.add(motion, c.t2, c.q2);
    make_monotone(motion);
    ASSERT_NEAR(motion.at(1).point.dq[3], c.expected, 1e-12);
    ASSERT_NEAR(motion.at(0).point.dq[3], 0.0, 0.0);
    ASSERT_NEAR(motion.at(2).point.dq[3], 0.0, 0.0);
  }
}

void velocities_that_do_not_overshoot_are_kept(void**) {
  static ReferenceBench bench;
  Trajectory<JointSpace>& motion = *bench.trajectory(kVelocityField);
  bench.add(motion, 0.0, 0.0, 0.0);
  bench.add(motion, 1.0, 0.1, 0.29);   // three times the secant before is 0.3
  bench.add(motion, 2.0, 0.3, 0.5);    // the secant after it allows 0.3
  bench.add(motion, 3.0, 0.4, -0.01);  // against both
  bench.add(motion, 4.0, 0.5, 0.0);
  make_monotone(motion);
  const double expected[] = {0.0, 0.29, 0.3, 0.0, 0.0};
  for (int i = 0; i < 5; ++i) ASSERT_NEAR(motion.at(i).point.dq[0], expected[i], 1e-12);
}

void rotations_about_one_axis_do_not_overshoot(void**) {
  static std::array<Waypoint<TaskSpace>, 20> waypoints;
  Trajectory<TaskSpace> motion;
  motion.waypoints = waypoints.data();
  motion.capacity = motion.count = 20;
  motion.interpolation = Interpolation::kMonotone;
  Random random{10};
  const Vector3 axis = Vector3(1.0, -2.0, 0.5).normalized();
  std::array<double, 20> angles;
  double time_s = 0.0, angle = 0.0;
  for (int i = 0; i < 20; ++i) {
    waypoints[i].time_s = time_s;
    waypoints[i].point.x.r = exp_so3(angle * axis);
    angles[i] = angle;
    time_s += random.uniform(0.5, 2.0);
    angle += random.uniform(-2.0, 2.0);
  }
  make_monotone(motion);
  for (int i = 1; i < 20; ++i) {
    const TaskSpace::Segment segment = motion.segment(i, {});
    const double all = std::abs(angles[i] - angles[i - 1]);
    for (int k = 0; k <= 50; ++k) {
      const Eigen::Quaterniond r = segment.at(segment.duration() * k / 50).x.r;
      ASSERT_NEAR(
          angle_between(r, waypoints[i].point.x.r) + angle_between(waypoints[i - 1].point.x.r, r),
          all, 1e-7);
    }
  }
}

void a_file_may_ask_for_it_and_a_stream_may_not(void**) {
  static ReferenceBench bench;
  Trajectory<JointSpace>* motion = bench.trajectory(0);
  motion->interpolation = Interpolation::kMonotone;
  bench.add(*motion, 0.0, 0.0);
  bench.add(*motion, 1.0, 0.2);
  bench.add(*motion, 2.0, 0.3);
  motion->open = true;
  ASSERT_STATUS(bench.client.admit(*motion).status, Status::kNotStreamable);
  motion->open = false;
  std::uint32_t id = 0;
  assert_true(bench.client.send(*motion, id).ok());
  double last = 0.0;
  for (int k = 0; k < 2100; ++k) {
    ASSERT_OK(bench.step());
    assert_true(bench.out().q[0] - bench.home.q[0] >= last - 1e-15);
    last = bench.out().q[0] - bench.home.q[0];
  }
  ASSERT_NEAR(last, 0.3, 1e-12);
  motion = bench.trajectory(0);
  motion->interpolation = Interpolation::kMonotone;
  bench.add(*motion, 0.0, 0.3);
  bench.add(*motion, 1.0, static_cast<double>(NAN));
  const Verdict verdict = bench.client.admit(*motion);
  ASSERT_STATUS(verdict.status, Status::kReferenceNotFinite);
  assert_int_equal(verdict.waypoint, 1);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(between_two_waypoints_no_joint_goes_beyond_either),
      cmocka_unit_test(velocity_stays_continuous),
      cmocka_unit_test(velocities_are_the_weighted_harmonic_means_of_the_secants),
      cmocka_unit_test(velocities_that_do_not_overshoot_are_kept),
      cmocka_unit_test(rotations_about_one_axis_do_not_overshoot),
      cmocka_unit_test(a_file_may_ask_for_it_and_a_stream_may_not),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
