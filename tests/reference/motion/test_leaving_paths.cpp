// Leaving a path: by a brake at once, where braking on the path takes too long, and close to limits
// that a straight stop would exceed.
// Paths that end, or are given up again, while they are being left for a point.
#include <array>

#include "tests/reference/motion/checked_motion.hpp"

namespace tactus {
namespace {

/// Returns when joints 1 and 2 come to rest, seconds from now.
std::array<double, 2> standing_times(CheckedJoints& bench) {
  std::array<double, 2> stood_s{};
  for (int k = 1; !bench.out().standing(); ++k) {
    bench.cycle();
    for (int j = 0; j < 2; ++j) {
      const bool moves = bench.out().dq[j] != 0.0 || bench.out().ddq[j] != 0.0;
      if (moves) stood_s[static_cast<std::size_t>(j)] = k * bench.period_s;
    }
  }
  return stood_s;
}

// Proves RG-11, RG-21.

void a_brake_at_once_leaves_the_path_and_every_joint_takes_its_least_time(void**) {
  JointVector dq = only(0, 2.0);
  dq[1] = 0.2;
  const double least_0 = TimeOptimum(axis_limits(0)).stopping_time_s(dq[0]);
  const double least_1 = TimeOptimum(axis_limits(1)).stopping_time_s(dq[1]);
  CheckedJoints on_path, at_once;
  cruise(on_path, on_path.home.q, dq, 0.5);
  on_path.brake(Status::kHalted);
  const auto together = standing_times(on_path);
  ASSERT_NEAR(together[0], together[1], 1e-9);
  cruise(at_once, at_once.home.q, dq, 0.5);
  at_once.brake(Status::kHalted);
  at_once.cycle();
  at_once.brake(Status::kCollision, BrakeWay::kAtOnce);
  at_once.cycle();
  ASSERT_STATUS(at_once.generator.phase(), MotionPhase::kStopping);
  const auto alone = standing_times(at_once);
  print_message("on the path %.3f and %.3f s, at once %.3f and %.3f s, least %.3f and %.3f s\n",
                together[0], together[1], alone[0], alone[1], least_0, least_1);
  assert_true(alone[0] <= least_0 && alone[1] <= least_1 && alone[1] < 0.5 * together[1]);
}

/// Sends a motion of joint 1 that slows down from 1 rad/s at its limit, 0.5 rad/s^2.
std::uint32_t slow_down_at_the_limit(CheckedJoints& bench) {
  constexpr double kLimit = 0.5, kBraking = -0.4999;
  JointLimits& limits = bench.channel.settings.limits;
  limits.ddq_max[0] = kLimit;
  bench.channel.settings.stop_reserve = 0.0;
  bench.oracle.begin(limits, bench.period_s, Smoothness::kAcceleration, kRateJerk);
  bench.home.q[0] = -1.7;
  ASSERT_OK(bench.start(bench.home));
  Trajectory<JointSpace>* motion = bench.trajectory(kQuintics);
  JointSpace::Point point = bench.home;
  const auto go_on = [&](double T, double way, double dq, double ddq) {
    point.q[0] += way;
    point.dq[0] = dq;
    point.ddq[0] = ddq;
    bench.add(*motion, (motion->count > 0 ? motion->end_s() : 0.0) + T, point);
  };
  go_on(0.0, 0.0, 0.0, 0.0);
  go_on(4.0, 2.0, 1.0, 0.0);
  const double to_braking = 1.0 + 0.5 * 0.2 * kBraking, braked = to_braking + 1.8 * kBraking;
  go_on(0.2, 0.2 * 1.0 + 0.15 * 0.2 * 0.2 * kBraking, to_braking, kBraking);
  go_on(1.8, 1.8 * 0.5 * (to_braking + braked), braked, kBraking);
  go_on(1.0, 0.4 * braked, 0.0, 0.0);
  const std::uint32_t id = bench.send(*motion);
  assert_int_not_equal(id, 0);
  return id;
}

void a_path_that_cannot_be_stopped_on_is_left_after_half_a_second_and_that_is_told(void**) {
  CheckedJoints bench;
  const std::uint32_t id = slow_down_at_the_limit(bench);
  bench.run(4.3);
  assert_int_not_equal(bench.cancel(), 0);
  bench.cycle();
  ASSERT_STATUS(bench.report_of(id).outcome, Outcome::kCanceled);
  bench.run(0.48);
  ASSERT_STATUS(bench.generator.phase(), MotionPhase::kBraking);
  ASSERT_STATUS(bench.report_of(0).id, 0);
  bench.run(0.03);
  ASSERT_STATUS(bench.generator.phase(), MotionPhase::kStopping);
  Report left;
  while (bench.client.poll(left)) continue;
  ASSERT_STATUS(left.outcome, Outcome::kReleased);
  ASSERT_STATUS(left.verdict.status, Status::kLeftPath);
  bench.stop(3.0);
  assert_true(bench.out().standing());
}

/// A tip that follows half a circle, which touches a side of its workspace 45 degrees after its
/// beginning.
struct TipOnABend : CheckedTip {
  static constexpr double kRadius = 0.1, kSpeed = 1.0, kFollows_m = 0.02,
                          kPi = 3.14159265358979323846;

  explicit TipOnABend(double period) : CheckedTip(period) {
    TaskLimits& limits = channel.settings.limits;
    params.tolerances.path.position_m = kFollows_m;
    const Vector3 middle = home.x.p;
    limits.p_max = middle + Vector3(kRadius, 1.0, 1.0);
    oracle.begin(limits, period, Smoothness::kAcceleration, kRateJerk);
    Trajectory<TaskSpace>* motion = trajectory(kQuintics);
    constexpr int kArc = 20;
    const double omega = kSpeed / kRadius, step_s = kPi / omega / kArc, run_s = 0.5;
    Point point = home;
    for (int i = 0; i <= kArc; ++i) {
      const double angle = kPi * i / kArc - 0.25 * kPi;
      const Vector3 out(std::cos(angle), std::sin(angle), 0.0), on(-out.y(), out.x(), 0.0);
      point.x.p = middle + kRadius * out;
      if (i == 0) lead(*motion, point, -0.5 * kSpeed * run_s * on);
      point.v.head<3>() = kSpeed * on;
      point.a.head<3>() = -kSpeed * omega * out;
      add(*motion, run_s + i * step_s, point);
    }
    point.x.p += 0.5 * run_s * point.v.head<3>();
    point.v.setZero();
    point.a.setZero();
    add(*motion, 2.0 * run_s + kArc * step_s, point);
    id = send(*motion);
    assert_int_not_equal(id, 0);
  }
  /// Starts at the first waypoint, from which the tip accelerates.
  void lead(Trajectory<TaskSpace>& motion, const Point& begin, const Vector3& away) {
    Point point = begin;
    point.x.p += away;
    ASSERT_OK(start(point));
    oracle.forget();
    add(motion, 0.0, point);
  }
  std::uint32_t id = 0;
};

void a_tip_that_is_called_off_a_bend_along_a_side_of_its_workspace_stays_inside(void**) {
  for (const double period : {1e-3, 2e-3, 8e-3}) {
    int left = 0;
    for (double at_s = 0.5; at_s < 0.6; at_s += 0.002) {
      TipOnABend bench(period);
      bench.run(at_s);
      TaskSpace::Point point = bench.home;
      point.h[2] = 5.0;
      assert_int_not_equal(bench.send(point), 0);
      for (int k = bench.cycles(2.0); k > 0; --k) {
        bench.cycle();
        if (bench.generator.phase() == MotionPhase::kLeaving) ++left;
      }
      ASSERT_STATUS(bench.generator.phase(), MotionPhase::kHolding);
      ASSERT_NEAR((bench.out().x.p - bench.home.x.p).norm(), 0.0, 1e-9);
      ASSERT_NEAR(bench.out().h[2], 5.0, 0.0);
      ASSERT_STATUS(bench.report_of(bench.id).outcome, Outcome::kAborted);
      for (int i = 0; i < kStores; ++i) assert_non_null(bench.client.acquire());
    }
    assert_true(left > 0);
  }
}

void a_trajectory_that_is_sent_on_that_bend_is_refused_or_keeps_inside(void**) {
  for (const double period : {1e-3, 2e-3, 8e-3}) {
    int refused = 0, taken = 0;
    for (double at_s = 0.4; at_s < 0.7; at_s += 0.004) {
      TipOnABend bench(period);
      bench.run(at_s);
      Trajectory<TaskSpace>* elsewhere = bench.trajectory(kQuintics);
      bench.add(*elsewhere, 1.0, bench.home.at_rest());
      const std::uint32_t id = bench.send(*elsewhere);
      assert_int_not_equal(id, 0);
      bench.cycle();
      const Report report = bench.report_of(id);
      const bool no = report.outcome == Outcome::kRefused;
      if (no) ASSERT_STATUS(report.verdict.status, Status::kCannotLeave);
      ++(no ? refused : taken);
      bench.run(3.0);
      ASSERT_STATUS(bench.report_of(no ? bench.id : id).outcome, Outcome::kSucceeded);
    }
    print_message("%d refused, %d taken\n", refused, taken);
    assert_true(refused > 0 && taken > 0);
  }
}

void a_robot_that_does_not_follow_is_stopped_inside_too(void**) {
  int left = 0;
  for (double at_s = 0.5; at_s < 0.6; at_s += 0.002) {
    TipOnABend bench(1e-3);
    bench.run(at_s);
    TaskSpace::Point elsewhere = bench.out();
    elsewhere.x.p.z() += 2.0 * TipOnABend::kFollows_m;
    bench.cycle(elsewhere);
    const Report report = bench.report_of(bench.id);
    ASSERT_STATUS(report.outcome, Outcome::kAborted);
    ASSERT_STATUS(report.verdict.status, Status::kPathTolerance);
    if (bench.generator.phase() == MotionPhase::kBraking) ++left;
    bench.stop(1.0);
    assert_true(bench.out().standing());
    bench.run(0.01);
    for (int i = 0; i < kStores; ++i) assert_non_null(bench.client.acquire());
  }
  assert_true(left > 0);
}

/// A stream gave joint 1 a velocity and dries up where the shortest stop would end a millionth of a
/// radian beyond its range, and a harder one, that swings back, inside.
void a_stream_that_dries_up_just_before_an_end_of_the_range_stays_inside(void**) {
  const JointLimits limits;
  constexpr double kBeyond = 1e-6, kSpeed = 1.0;
  const double way = TimeOptimum(axis_limits(0)).stopping_way(kSpeed);
  for (const double side : {1.0, -1.0}) {
    MotionBench<JointSpace> bench(1e-3, OnlineMode::kForward);
    bench.params.timeout_s = 0.01;
    ASSERT_OK(bench.start(bench.home));
    JointSpace::Point point = bench.home;
    const double end = side > 0.0 ? limits.q_max[0] : limits.q_min[0];
    point.q[0] = end - side * (way - kBeyond);
    point.dq[0] = side * kSpeed;
    assert_int_not_equal(bench.send(point), 0);
    double farthest = -1.0;
    for (int k = 0; k < 1000; ++k) {
      ASSERT_OK(bench.step());
      farthest = std::max(farthest, side * (bench.out().q[0] - end));
    }
    assert_true(bench.out().standing());
    assert_true(farthest <= 1e-9 && farthest >= -kBeyond);
  }
}

/// A joint that goes straight to an end of its range, nearly as fast as it may stop there, and back
/// if it `returns`.
struct LinesToTheEnd : CheckedJoints {
  JointSpace::Point begin = home, end = home;

  LinesToTheEnd(double side, bool returns)
      : CheckedJoints(1e-3, OnlineMode::kLimit, Smoothness::kPosition) {
    const JointLimits limits;
    end.q[0] = side > 0.0 ? limits.q_max[0] : limits.q_min[0];
    begin.q[0] = end.q[0] - side * 0.45 * limits.velocity_step[0];
    ASSERT_OK(start(begin));
    oracle.forget();
    Trajectory<JointSpace>* motion = trajectory(0);
    add(*motion, 0.0, begin);
    add(*motion, 1.0, end);
    if (returns) add(*motion, 2.0, begin);
    assert_int_not_equal(send(*motion), 0);
  }
};

template <class Check>
void over_lines(Check check) {
  for (const double side : {1.0, -1.0}) {
    for (const bool returns : {true, false}) {
      for (double at_s = 0.95; at_s < 1.0; at_s += 0.001) {
        LinesToTheEnd bench(side, returns);
        bench.run(at_s);
        check(bench, side);
      }
    }
  }
}

// Proves RG-21.

void a_joint_that_is_called_off_lines_at_an_end_of_its_range_stays_inside(void**) {
  over_lines([](LinesToTheEnd& bench, double side) {
    assert_int_not_equal(bench.send(bench.home), 0);
    for (int k = bench.cycles(3.0); k > 0; --k) {
      bench.cycle();
      assert_true(side * (bench.out().q[0] - bench.end.q[0]) <= 1e-9);
    }
    ASSERT_STATUS(bench.generator.phase(), MotionPhase::kHolding);
    ASSERT_NEAR((bench.out().q - bench.home.q).norm(), 0.0, 1e-9);
  });
}

/// A point with a velocity is a stream by itself.
void a_stream_that_is_canceled_before_the_path_could_be_left_for_it_is_not_followed(void**) {
  int left = 0;
  over_lines([&left](LinesToTheEnd& bench, double side) {
    JointSpace::Point point = bench.home;
    point.dq[0] = -0.1 * side;
    assert_int_not_equal(bench.send(point), 0);
    bench.cycle();
    if (bench.generator.phase() != MotionPhase::kLeaving) return;
    ++left;
    assert_int_not_equal(bench.cancel(), 0);
    bench.stop(1.0);
    const JointVector rest = bench.out().q;
    bench.run(0.5);
    assert_true(bench.out().q == rest);
    ASSERT_STATUS(bench.generator.phase(), MotionPhase::kHolding);
  });
  assert_true(left > 0);
}

/// The last waypoint has an acceleration, which the joint runs out.
void a_path_that_ends_while_it_is_braked_on_does_not_step(void**) {
  for (int before_end = 1; before_end < 60; ++before_end) {
    CheckedJoints bench;
    JointSpace::Point point = bench.home;
    Trajectory<JointSpace>* motion = bench.trajectory(kQuintics);
    bench.add(*motion, 0.0, point);
    point.q[0] += 0.1;
    point.ddq[0] = -10.0;
    bench.add(*motion, 1.0, point);
    assert_int_not_equal(bench.send(*motion), 0);
    bench.run(1.0 - before_end * bench.period_s);
    assert_int_not_equal(bench.cancel(), 0);
    bench.run(0.5);
    assert_true(bench.out().standing());
    ASSERT_STATUS(bench.generator.phase(), MotionPhase::kHolding);
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_brake_at_once_leaves_the_path_and_every_joint_takes_its_least_time),
      cmocka_unit_test(
          a_path_that_cannot_be_stopped_on_is_left_after_half_a_second_and_that_is_told),
      cmocka_unit_test(a_tip_that_is_called_off_a_bend_along_a_side_of_its_workspace_stays_inside),
      cmocka_unit_test(a_trajectory_that_is_sent_on_that_bend_is_refused_or_keeps_inside),
      cmocka_unit_test(a_robot_that_does_not_follow_is_stopped_inside_too),
      cmocka_unit_test(a_stream_that_dries_up_just_before_an_end_of_the_range_stays_inside),
      cmocka_unit_test(a_joint_that_is_called_off_lines_at_an_end_of_its_range_stays_inside),
      cmocka_unit_test(
          a_stream_that_is_canceled_before_the_path_could_be_left_for_it_is_not_followed),
      cmocka_unit_test(a_path_that_ends_while_it_is_braked_on_does_not_step),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
