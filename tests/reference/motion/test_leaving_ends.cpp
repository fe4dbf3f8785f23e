// Paths that end, or are given up again, while they are being left for a point.
#include "tests/reference/motion/checked_motion.hpp"

namespace {

using namespace tactus;

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
    ASSERT_STATUS(bench.generator.phase(), Phase::kHolding);
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
    if (bench.generator.phase() != Phase::kLeaving) return;
    ++left;
    assert_int_not_equal(bench.cancel(), 0);
    bench.stop(1.0);
    const JointVector rest = bench.out().q;
    bench.run(0.5);
    assert_true(bench.out().q == rest);
    ASSERT_STATUS(bench.generator.phase(), Phase::kHolding);
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
    ASSERT_STATUS(bench.generator.phase(), Phase::kHolding);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_joint_that_is_called_off_lines_at_an_end_of_its_range_stays_inside),
      cmocka_unit_test(
          a_stream_that_is_canceled_before_the_path_could_be_left_for_it_is_not_followed),
      cmocka_unit_test(a_path_that_ends_while_it_is_braked_on_does_not_step),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
