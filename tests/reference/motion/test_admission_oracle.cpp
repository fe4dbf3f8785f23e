// Admission against an oracle that samples: random trajectories of two to five waypoints, three
// quarters of them stretched in time until they just about touch a limit.

#include "tests/reference/generator/reference_bench.hpp"
#include "tests/reference/motion/hermite_oracle.hpp"
#include "tests/support/testing.hpp"
#include "tests/support/trials.hpp"

namespace {

using namespace tactus;

/// Trajectories to judge.
constexpr int kUsual = 2000;

const HermiteOracle& oracle() {
  static const HermiteOracle oracle;
  return oracle;
}

constexpr Fields kFieldsOf[] = {0, kVelocityField, kVelocityField | kAccelerationField};
constexpr Status kCodes[] = {Status::kPositionLimit, Status::kVelocityLimit,
                             Status::kAccelerationLimit, Status::kJerkLimit};

/// Returns the largest magnitude allowed to a derivative of a joint; for the position, the upper
/// limit.
double limit_of(const AdmissionSettings<JointSpace>& settings, int derivative, int joint) {
  const JointLimits& limits = settings.limits;
  const double share = 1.0 - settings.stop_reserve;
  const double all[] = {limits.q_max[joint], limits.dq_max[joint], share * limits.ddq_max[joint],
                        share * limits.dddq_max[joint]};
  return all[derivative];
}
double lower_limit_of(const AdmissionSettings<JointSpace>& settings, int derivative, int joint) {
  return derivative == 0 ? settings.limits.q_min[joint] : -limit_of(settings, derivative, joint);
}

/// Returns the step in velocity of a joint at the beginning of the segment that ends at `waypoint`,
/// or, for the number after the last, at the end. A line at t = 0 is left from rest; in all other
/// cases the way to the first waypoint is judged when the motion begins, so its step counts as
/// zero.
double step_before(const Trajectory<JointSpace>& motion, int waypoint, int joint) {
  const double before = waypoint > 1 ? oracle().velocity(motion, waypoint - 1, joint, true) : 0.0;
  if (waypoint == motion.count) return -before;
  const double after = oracle().velocity(motion, waypoint, joint, false);
  const bool line = motion.interpolation == Interpolation::kLinear || motion.fields == 0;
  if (waypoint == 1 && !(line && motion.waypoints[0].time_s == 0.0)) return 0.0;
  return after - before;
}

/// Returns the sum of the steps, which falls in between at the acceleration limit.
double steps_until(const Trajectory<JointSpace>& motion, int waypoint, int joint) {
  double sum = 0.0;
  for (int i = 1; i <= waypoint; ++i) {
    const double before =
        i > 1 ? motion.waypoints[i - 1].time_s - motion.waypoints[i - 2].time_s : 0.0;
    sum = std::fmax(0.0, sum - JointLimits().ddq_max[joint] * before);
    sum += std::fabs(step_before(motion, i, joint));
  }
  return sum;
}

/// Fills in waypoints around home, or around a place close to a position limit of every joint.
void fill(ReferenceBench& bench, Trajectory<JointSpace>& motion, Random& random) {
  const JointLimits limits;
  const double size = std::pow(10.0, random.uniform(-5.0, 0.2));  // rad
  const double spacing_s = random.uniform(0.5, 2.0) * std::sqrt(size);
  const double near = random.below(4) == 0 ? random.uniform(0.9, 1.0) : 0.0;
  double time_s = random.below(2) ? 0.0 : 1.0;
  const int count = 2 + random.below(4);
  for (int i = 0; i < count; ++i) {
    bench.add(motion, time_s, 0.0);
    time_s += spacing_s * random.uniform(0.5, 1.5);
    JointSpace::Point& point = motion.waypoints[i].point;
    for (int j = 0; j < kDof; ++j) {
      const double centre = point.q[j] + near * (limits.q_max[j] - point.q[j]);
      point.q[j] =
          std::clamp(centre + random.uniform(-size, size), limits.q_min[j], limits.q_max[j]);
      if (i + 1 == count || !(motion.fields & kVelocityField)) continue;
      point.dq[j] = random.uniform(-1.0, 1.0) * size / spacing_s;
      if (motion.fields & kAccelerationField)
        point.ddq[j] = random.uniform(-3.0, 3.0) * size / (spacing_s * spacing_s);
    }
  }
}

/// Stretches the motion in time so that the largest use of a limit is about one.
void touch_a_limit(const ReferenceBench& bench, Trajectory<JointSpace>& motion, Random& random) {
  const AdmissionSettings<JointSpace>& settings = bench.channel.settings;
  double stretch = 1e-3;
  for (int i = 1; i <= motion.count; ++i) {
    for (int j = 0; j < kDof; ++j) {
      stretch = std::fmax(stretch,
                          std::fabs(step_before(motion, i, j)) / settings.limits.velocity_step[j]);
      if (i == motion.count) continue;
      const Ranges ranges = oracle().ranges(motion, i, j, 20);
      for (int k = 1; k < kDerivatives; ++k) {
        const Range1& range = ranges[static_cast<std::size_t>(k)];
        const double use = std::fmax(range.max, -range.min) / limit_of(settings, k, j);
        stretch = std::fmax(stretch, std::pow(use, 1.0 / k));
      }
    }
  }
  stretch *= random.uniform(0.99, 1.01);
  for (int i = 0; i < motion.count; ++i) {
    Waypoint<JointSpace>& waypoint = motion.waypoints[i];
    waypoint.time_s *= stretch;
    waypoint.point.dq /= stretch;
    waypoint.point.ddq /= stretch * stretch;
  }
}

/// Returns a random trajectory in a store of the bench, interpolated by its fields or by a forced
/// order.
Trajectory<JointSpace>& random_motion(ReferenceBench& bench, Random& random) {
  const int order = random.below(3);
  const bool forced = random.below(4) == 0;
  Trajectory<JointSpace>& motion = *bench.trajectory(kFieldsOf[forced ? 2 : order]);
  motion.exact = true;
  if (forced) motion.interpolation = static_cast<Interpolation>(1 + order);
  fill(bench, motion, random);
  if (random.below(4) != 0) touch_a_limit(bench, motion, random);
  return motion;
}

/// Asserts that no sample before `waypoint` breaks a limit by more than a billionth, which may be
/// rounding.
void assert_within_limits(const ReferenceBench& bench, const Trajectory<JointSpace>& motion,
                          int waypoint) {
  const AdmissionSettings<JointSpace>& settings = bench.channel.settings;
  for (int i = 1; i < waypoint; ++i) {
    for (int j = 0; j < kDof; ++j) {
      const Ranges ranges = oracle().ranges(motion, i, j, 1);
      for (int k = 0; k < kDerivatives; ++k) {
        const double limit = limit_of(settings, k, j), slack = 2e-9 + 1e-9 * std::fabs(limit);
        const Range1& range = ranges[static_cast<std::size_t>(k)];
        assert_true(range.max <= limit + slack);
        assert_true(range.min >= lower_limit_of(settings, k, j) - slack);
      }
      assert_true(std::fabs(step_before(motion, i, j)) <= settings.limits.velocity_step[j] + 1e-8);
    }
  }
}

/// Asserts that the verdict is true: a sample reaches the value, and it is beyond the limit.
void assert_violated(const ReferenceBench& bench, const Trajectory<JointSpace>& motion,
                     const Verdict& verdict) {
  const int i = verdict.waypoint, j = verdict.axis;
  if (verdict.status == Status::kReferenceTime) {
    const double spacing_s = motion.waypoints[i].time_s - motion.waypoints[i - 1].time_s;
    return assert_true(spacing_s < ReferenceBench::kPeriod_s / kMaxSegmentsPerCycle);
  }
  assert_true(i >= 0 && i < motion.count && j >= 0 && j < kDof);
  const double near = 1e-3 * std::fabs(verdict.limit);
  assert_true(std::fabs(verdict.value) > std::fabs(verdict.limit) ||
              verdict.status == Status::kPositionLimit);
  if (verdict.status == Status::kVelocityStep) {
    const bool here = std::fabs(steps_until(motion, i, j) - verdict.value) <= near;
    return assert_true(here || (i + 1 == motion.count &&
                                std::fabs(steps_until(motion, i + 1, j) - verdict.value) <= near));
  }
  int k = 0;
  while (k < kDerivatives && kCodes[k] != verdict.status) ++k;
  assert_true(k < kDerivatives);
  const double hi = limit_of(bench.channel.settings, k, j);
  const double lo = lower_limit_of(bench.channel.settings, k, j);
  assert_true(verdict.value > hi || verdict.value < lo);
  assert_true(verdict.limit == hi || verdict.limit == lo);
  const JointSpace::Point& point = motion.waypoints[i].point;
  if (verdict.value == point.q[j] || (k == 1 && verdict.value == point.dq[j])) return;
  assert_true(i > 0);
  const Ranges ranges = oracle().ranges(motion, i, j, 1);
  const Range1& range = ranges[static_cast<std::size_t>(k)];
  const double largest = std::fmax(range.max, -range.min);
  ASSERT_NEAR(k > 0 ? largest : verdict.value > hi ? range.max : range.min, verdict.value, near);
}

// Proves RG-6.

void what_is_admitted_keeps_every_limit_and_what_is_refused_breaks_the_one_named(void**) {
  static ReferenceBench bench;
  Random random{20261122};
  int admitted = 0;
  std::array<int, 64> refused{};
  for (int n = trials(kUsual); n > 0; --n) {
    Trajectory<JointSpace>& motion = random_motion(bench, random);
    const Verdict verdict = admit(motion, bench.channel.settings);
    // Times are judged first.
    const int judged = verdict.status == Status::kReferenceTime ? 0 : verdict.waypoint;
    assert_within_limits(bench, motion, verdict.ok() ? motion.count : judged);
    if (verdict.ok()) {
      ++admitted;
      for (int j = 0; j < kDof; ++j)
        assert_true(std::fabs(step_before(motion, motion.count, j)) <=
                    bench.channel.settings.limits.velocity_step[j] + 1e-8);
    } else {
      assert_violated(bench, motion, verdict);
      ++refused[static_cast<std::size_t>(verdict.status)];
    }
  }
  print_message("  %d admitted\n", admitted);
  assert_true(admitted > trials(kUsual) / 5);
  for (const Status code :
       {Status::kPositionLimit, Status::kVelocityLimit, Status::kAccelerationLimit,
        Status::kJerkLimit, Status::kVelocityStep}) {
    const int count = refused[static_cast<std::size_t>(code)];
    print_message("  %d refused by %s\n", count, name(code));
    assert_true(count > trials(kUsual) / 100);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(what_is_admitted_keeps_every_limit_and_what_is_refused_breaks_the_one_named),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
