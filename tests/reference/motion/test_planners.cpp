// Motions as time-optimal planners send them: computed to the limits and sampled, so that the
// interpolation between the samples exceeds them in places. tests/otg/planner has three motions of
// the FER from its ready pose, computed by an independent library of time-optimal motions and
// sampled every 8 and 100 ms as positions and velocities (pv), or with accelerations too (pva).
#include <cstdio>

#include "gateway/trajectory_csv.hpp"
#include "kernel/reference/motion/path_law.hpp"
#include "tests/reference/motion/path_cases.hpp"
#include "tests/support/testing.hpp"
#include "tests/support/trials.hpp"

namespace tactus {
namespace {

constexpr int kRuns = tries(60, 6);
constexpr double kSharpest = 1.25;  // jerk, of its limit

struct File {
  const char* name;
  double longest;  ///< stretch, as a fraction
};
constexpr File kFiles[] = {
    {"planner_1_8ms_pv", 0.1},    {"planner_1_8ms_pva", 0.1},   {"planner_1_100ms_pv", 0.1},
    {"planner_1_100ms_pva", 0.1}, {"planner_2_8ms_pv", 0.1},    {"planner_2_8ms_pva", 0.1},
    {"planner_2_100ms_pv", 0.1},  {"planner_2_100ms_pva", 0.1}, {"planner_3_8ms_pv", 0.1},
    {"planner_3_8ms_pva", 0.1},   {"planner_3_100ms_pv", 0.1},  {"planner_3_100ms_pva", 0.1},
};

std::array<Waypoint<JointSpace>, 128> waypoints;

Trajectory<JointSpace> load(const char* name) {
  std::array<char, 128> path;
  std::snprintf(path.data(), path.size(), "tests/otg/planner/%s.csv", name);
  Trajectory<JointSpace> trajectory;
  trajectory.waypoints = waypoints.data();
  trajectory.capacity = static_cast<int>(waypoints.size());
  CsvError error;
  assert_true(read_trajectory(path.data(), false, trajectory, error));
  return trajectory;
}

AdmissionSettings<JointSpace> settings(double period_s = 1e-3) {
  AdmissionSettings<JointSpace> settings;
  settings.period_s = period_s;
  return settings;
}

/// Runs a trajectory to its end, at full rate or at random ones: the largest use of velocity,
/// acceleration, at the samples and in the mean between them, and jerk, and its time.
struct Run {
  double v = 0.0, a = 0.0, jerk = 0.0, time_s = 0.0;

  Run(const Trajectory<JointSpace>& trajectory, double period_s, Random* random) {
    const KnownPath own(trajectory);
    const JointLimits limits;
    Path<JointSpace> path(trajectory, {}, limits);
    PathLaw<JointSpace> law;
    path.enter(0.0);
    law.start(path, 0.0, 1.0, JointSpace::peaks(limits), period_s);
    JointVector last = JointVector::Zero(), dq = JointVector::Zero();
    double target = 1.0, left_s = 0.0;
    while (!path.ended(law.s()) && time_s < 10.0) {
      left_s -= period_s;
      if (random != nullptr && left_s < 0.0) {
        target = random->below(3) == 0 ? 1.0 : random->uniform(0.0, 1.0);
        left_s = random->uniform(0.0, random->below(2) == 0 ? 0.03 : 0.3);
      }
      law.step(path, target, JointSpace::peaks(limits), period_s);
      time_s += period_s;
      const PathPlace now = own.place(law.s());
      const JointSpace::Point out = path.at(law.s()).at_rate(law.rate(), law.slope());
      const JointVector ddq = now.d2 * (law.rate() * law.rate()) + now.d1 * law.slope();
      for (int j = 0; j < kDof; ++j) {
        ASSERT_NEAR(out.q[j], now.q[j], 1e-9);
        ASSERT_NEAR(out.dq[j], now.d1[j] * law.rate(), 1e-8);
        v = std::fmax(v, std::fabs(out.dq[j]) / limits.dq_max[j]);
        a = std::fmax(a, std::fabs(ddq[j]) / limits.ddq_max[j]);
        a = std::fmax(a, std::fabs(out.dq[j] - dq[j]) / (period_s * limits.ddq_max[j]));
        jerk = std::fmax(jerk, std::fabs(ddq[j] - last[j]) / (period_s * limits.dddq_max[j]));
      }
      last = ddq;
      dq = out.dq;
    }
  }
};

// Proves RG-6, RG-24.

void what_a_planner_sampled_is_admitted_and_kept_within_limits(void**) {
  for (const File& file : kFiles) {
    Trajectory<JointSpace> trajectory = load(file.name);
    const Verdict verdict = admit(trajectory, settings());
    ASSERT_OK(verdict.status);
    const Run run(trajectory, 1e-3, nullptr);
    const double planned_s = trajectory.end_s();
    print_message("  %-20s admitted %.2f %% longer, ran %.2f %%; use v %.9f a %.9f j %.3f\n",
                  file.name, 100.0 * trajectory.stretch, 100.0 * (run.time_s / planned_s - 1.0),
                  run.v, run.a, run.jerk);
    assert_true(trajectory.stretch > 0.0 && trajectory.stretch <= file.longest);
    assert_true(run.time_s <= (1.0 + file.longest) * planned_s);
    assert_true(run.v <= 1.0 + 1e-9 && run.a <= 1.0 + 1e-9);
    const bool smooth = (trajectory.fields & kAccelerationField) != 0;
    assert_true(!smooth || run.jerk <= 1.001);
  }
}

/// Where the samples of a planner are slowed down, jerk may give way to the rate that is allowed.
void what_a_planner_sampled_keeps_limits_at_any_rate_and_period(void**) {
  for (const double period_s : {1e-3, 2e-3, 8e-3}) {
    for (const File& file : kFiles) {
      Trajectory<JointSpace> trajectory = load(file.name);
      ASSERT_OK(admit(trajectory, settings(period_s)).status);
      const bool smooth = (trajectory.fields & kAccelerationField) != 0;
      Random random{20261127};
      int sharp = 0;
      double a = 0.0, jerk = 0.0;
      for (int n = trials(kRuns); n > 0; --n) {
        const Run run(trajectory, period_s, &random);
        a = std::fmax(a, run.a);
        jerk = std::fmax(jerk, run.jerk);
        sharp += run.jerk > 1.001;
      }
      print_message("  %-20s %g ms: a %.9f, jerk %.3f, above its limit in %d runs\n", file.name,
                    1e3 * period_s, a, jerk, sharp);
      assert_true(a <= 1.0 + 1e-9);
      assert_true(!smooth || jerk <= kSharpest);
    }
  }
}

void what_must_keep_its_times_or_be_hardly_longer_is_refused(void**) {
  Trajectory<JointSpace> trajectory = load("planner_1_8ms_pva");
  trajectory.exact = true;
  assert_false(admit(trajectory, settings()).ok());
  trajectory.exact = false;
  AdmissionSettings<JointSpace> strict = settings();
  strict.max_stretch = 0.01;
  const Verdict verdict = admit(trajectory, strict);
  assert_true(verdict.value > verdict.limit && verdict.waypoint > 0 && verdict.axis >= 0);
}

void positions_alone_may_be_dense_but_no_zigzag(void**) {
  for (const char* name : {"planner_1_8ms_pv", "planner_2_8ms_pv", "planner_3_8ms_pv"}) {
    Trajectory<JointSpace> trajectory = load(name);
    trajectory.fields = 0;
    ASSERT_OK(admit(trajectory, settings()).status);
  }
  Trajectory<JointSpace> zigzag = load("planner_1_8ms_pv");
  zigzag.fields = 0;
  for (int i = 0; i < zigzag.count; ++i) {
    zigzag.waypoints[i].time_s = 1e-3 * i;
    zigzag.waypoints[i].point = zigzag.waypoints[0].point;
    zigzag.waypoints[i].point.q[0] += i % 2 == 0 ? 0.0 : 0.27e-3;  // 0.54 rad/s at each corner
  }
  const Verdict verdict = admit(zigzag, settings());
  ASSERT_STATUS(verdict.status, Status::kVelocityStep);
  assert_int_equal(verdict.axis, 0);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(what_a_planner_sampled_is_admitted_and_kept_within_limits),
      cmocka_unit_test(what_a_planner_sampled_keeps_limits_at_any_rate_and_period),
      cmocka_unit_test(what_must_keep_its_times_or_be_hardly_longer_is_refused),
      cmocka_unit_test(positions_alone_may_be_dense_but_no_zigzag),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
