// Motions as planners send them: at the limits, from the measured state, with fields they do not
// declare; and positions that no arm can follow.
// Motions as time-optimal planners send them: computed to the limits and sampled, so that the
// interpolation between the samples exceeds them in places. tests/oracles/otg/planner has three
// motions of the FER from its ready pose, computed by an independent library of time-optimal
// motions and sampled every 8 and 100 ms as positions and velocities (pv), or with accelerations
// too (pva).
#include <cstdio>

#include "gateway/trajectory/trajectory_reader.hpp"
#include "kernel/reference/motion/path_law.hpp"
#include "tests/reference/motion/checked_motion.hpp"
#include "tests/reference/motion/path_cases.hpp"
#include "tests/support/testing.hpp"
#include "tests/support/trials.hpp"

namespace tactus {
namespace {

/// Returns a motion from home to rest by one quintic, given at 21 waypoints, that uses `share` of
/// joint 1's acceleration limit. Its largest acceleration is 10 / sqrt(3) times way / T^2.
Trajectory<JointSpace>* planned(CheckedJoints& bench, double share, double way) {
  const double a = share * bench.channel.settings.limits.ddq_max[0];
  const double T = std::sqrt(10.0 / std::sqrt(3.0) * way / a);
  constexpr int kSamples = 20;
  Trajectory<JointSpace>* motion = bench.trajectory(kQuintics);
  for (int i = 0; i <= kSamples; ++i) {
    const double x = static_cast<double>(i) / kSamples, T2 = T * T;
    JointSpace::Point point = bench.home;
    point.q[0] += way * x * x * x * (10.0 + x * (6.0 * x - 15.0));
    point.dq[0] = way / T * 30.0 * x * x * (1.0 - x) * (1.0 - x);
    point.ddq[0] = way / T2 * 60.0 * x * (1.0 - x) * (1.0 - 2.0 * x);
    if (i == kSamples) {
      point.dq.setZero();
      point.ddq.setZero();
    }
    bench.add(*motion, x * T, point);
  }
  return motion;
}

/// Runs a motion to its end, which must be `way` from home; returns the seconds it took.
double duration_s(CheckedJoints& bench, std::uint32_t id, double way) {
  const double begun_s = bench.generator.time_s();
  while (bench.generator.time_s() - begun_s < 10.0) {
    bench.cycle();
    const Report report = bench.report_of(id);
    if (report.id == 0 || report.outcome == Outcome::kStarted) continue;
    ASSERT_STATUS(report.outcome, Outcome::kSucceeded);
    break;
  }
  ASSERT_NEAR(bench.out().q[0] - bench.home.q[0], way, 1e-9);
  return bench.generator.time_s() - begun_s;
}

// Proves RG-24.

void a_plan_at_or_little_over_the_limits_is_slowed_down_within_them(void**) {
  for (const double share : {0.98, 1.0, 1.05, 1.15}) {
    CheckedJoints bench;
    Trajectory<JointSpace>* motion = planned(bench, share, 0.4);
    const double planned_s = motion->end_s();
    const std::uint32_t id = bench.send(*motion);
    print_message("%.2f of the acceleration limit\n", share);
    assert_int_not_equal(id, 0);
    const double took_s = duration_s(bench, id, 0.4);
    print_message("  %.4f s, planned %.4f s\n", took_s, planned_s);
    assert_true(took_s <= 1.1 * planned_s + 3.0 * bench.period_s);
  }
}

void a_plan_far_over_the_limits_is_refused(void**) {
  CheckedJoints bench;
  assert_int_equal(bench.send(*planned(bench, 2.0, 0.4)), 0);
}

void the_last_waypoint_may_carry_the_acceleration_it_brakes_with(void**) {
  CheckedJoints bench;
  Trajectory<JointSpace>* motion = planned(bench, 0.8, 0.4);
  Waypoint<JointSpace>& last = motion->waypoints[motion->count - 1];
  last.point.ddq[0] = -0.9 * bench.channel.settings.limits.ddq_max[0];
  const std::uint32_t id = bench.send(*motion);
  assert_int_not_equal(id, 0);
  bench.run(3.0);
  ASSERT_STATUS(bench.report_of(id).outcome, Outcome::kSucceeded);
  ASSERT_NEAR(bench.out().q[0] - bench.home.q[0], 0.4, 1e-9);
  assert_true(bench.out().standing());
}

void a_plan_from_where_the_robot_is_measured_to_be_is_followed(void**) {
  CheckedJoints bench;
  constexpr double kSag = 0.015;  // rad, by which the reference is above the arm
  const auto measured = [&] {
    JointSpace::Point point = bench.out();
    point.q[0] -= kSag;
    return point;
  };
  for (int k = 0; k < 10; ++k) bench.cycle(measured());
  bench.home = measured();
  Trajectory<JointSpace>* motion = planned(bench, 0.5, 0.4);
  const std::uint32_t id = bench.send(*motion);
  assert_int_not_equal(id, 0);
  for (int k = 0; k < 3000; ++k) bench.cycle(measured());
  ASSERT_STATUS(bench.report_of(id).outcome, Outcome::kSucceeded);
}

void fields_that_are_not_declared_are_not_judged(void**) {
  for (const double garbage : {1e9, static_cast<double>(NAN)}) {
    CheckedJoints bench(1e-3, OnlineMode::kLimit, Smoothness::kPosition);
    Trajectory<JointSpace>* motion = bench.trajectory(0);
    for (int i = 1; i <= 4; ++i) {
      JointSpace::Point point = bench.home;
      point.q[0] += 0.05 * i;
      point.dq.setConstant(garbage);
      point.ddq.setConstant(garbage);
      point.tau.setConstant(garbage);
      bench.add(*motion, 0.5 * i, point);
    }
    const std::uint32_t id = bench.send(*motion);
    assert_int_not_equal(id, 0);
    duration_s(bench, id, 0.2);
    assert_true(bench.out().idle());
  }
}

/// Positions every millisecond between which the velocity changes by 0.54 rad/s, 36 times as much
/// as the acceleration limit allows.
void positions_that_zigzag_are_refused(void**) {
  CheckedJoints bench;
  Trajectory<JointSpace>* motion = bench.trajectory(0);
  for (int i = 0; i < 20; ++i) {
    JointSpace::Point point = bench.home;
    point.q[0] += 0.54e-3 * (i / 2);
    bench.add(*motion, 1e-3 * i, point);
  }
  assert_int_equal(bench.send(*motion), 0);
}

void positions_far_apart_are_joined_by_lines_as_ever(void**) {
  CheckedJoints bench(1e-3, OnlineMode::kLimit, Smoothness::kPosition);
  Trajectory<JointSpace>* motion = bench.trajectory(0);
  for (int i = 0; i <= 4; ++i) {
    JointSpace::Point point = bench.home;
    point.q[0] += 0.2 * (i % 2);
    bench.add(*motion, i, point);
  }
  const std::uint32_t id = bench.send(*motion);
  assert_int_not_equal(id, 0);
  duration_s(bench, id, 0.0);
}

// Proves RG-6, RG-21.

/// A quintic over 0.11 mrad in 9.5 ms takes 7 rad/s^2, which joint 1 may, and 7698 rad/s^3, which
/// it may not; in 12.5 ms both. From rest, and on the way.
void the_way_to_the_first_waypoint_is_judged_by_its_jerk_too(void**) {
  for (const double dq : {0.0, 0.5}) {
    for (const double time_s : {0.0095, 0.0125}) {
      CheckedJoints bench;
      const bool soft = time_s > 0.01;
      if (dq > 0.0) cruise(bench, bench.home.q, only(0, dq));
      Trajectory<JointSpace>* motion = bench.trajectory(kQuintics);
      JointSpace::Point point = bench.out();
      point.q[0] += dq * (time_s + bench.period_s) + 0.11e-3;
      bench.add(*motion, time_s, point);
      point.q[0] += 0.25 * dq;
      point.dq[0] = 0.0;
      if (dq > 0.0) bench.add(*motion, time_s + 0.5, point);
      const std::uint32_t id = bench.send(*motion);
      assert_int_not_equal(id, 0);
      bench.cycle();
      const Report report = bench.report_of(id);
      ASSERT_STATUS(report.outcome, soft ? Outcome::kStarted : Outcome::kRefused);
      if (dq == 0.0 && !soft) ASSERT_STATUS(report.verdict.status, Status::kJerkLimit);
      bench.run(0.1);  // whatever runs now keeps the limits
    }
  }
}

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
  std::snprintf(path.data(), path.size(), "tests/oracles/otg/planner/%s.csv", name);
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
      cmocka_unit_test(a_plan_at_or_little_over_the_limits_is_slowed_down_within_them),
      cmocka_unit_test(a_plan_far_over_the_limits_is_refused),
      cmocka_unit_test(the_last_waypoint_may_carry_the_acceleration_it_brakes_with),
      cmocka_unit_test(a_plan_from_where_the_robot_is_measured_to_be_is_followed),
      cmocka_unit_test(fields_that_are_not_declared_are_not_judged),
      cmocka_unit_test(positions_that_zigzag_are_refused),
      cmocka_unit_test(positions_far_apart_are_joined_by_lines_as_ever),
      cmocka_unit_test(the_way_to_the_first_waypoint_is_judged_by_its_jerk_too),
      cmocka_unit_test(what_a_planner_sampled_is_admitted_and_kept_within_limits),
      cmocka_unit_test(what_a_planner_sampled_keeps_limits_at_any_rate_and_period),
      cmocka_unit_test(what_must_keep_its_times_or_be_hardly_longer_is_refused),
      cmocka_unit_test(positions_alone_may_be_dense_but_no_zigzag),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
