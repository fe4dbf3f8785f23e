// Streams of points under `online = limit`: the lag of the reference, the smoothness with which it
// follows, and its end when the stream ends.
#include <array>

#include "tests/reference/motion/checked_motion.hpp"
#include "tests/streams/chunk_bench.hpp"
#include "tests/support/random.hpp"
#include "tests/support/trials.hpp"

namespace {

using namespace tactus;

constexpr double kPi = 3.14159265358979323846;

/// Returns a point with joint 1 at `q` rad from home, moving at `dq`, and all others at home.
JointSpace::Point point_at(const CheckedJoints& bench, double q, double dq) {
  JointSpace::Point point = bench.home;
  point.q[0] += q;
  point.dq[0] = dq;
  return point;
}

/// Returns the largest lag behind a ramp of 0.5 rad/s given in every cycle, once the reference has
/// caught up, s.
double ramp_lag_s(bool with_velocity) {
  constexpr double kRamp = 0.5;
  CheckedJoints bench;
  double lag_s = 0.0;
  while (bench.generator.time_s() < 2.0) {
    const double q = kRamp * bench.generator.time_s();
    assert_int_not_equal(bench.send(point_at(bench, q, with_velocity ? kRamp : 0.0)), 0);
    bench.cycle();
    bench.report_of(0);
    const double behind = kRamp * bench.generator.time_s() - (bench.out().q[0] - bench.home.q[0]);
    if (bench.generator.time_s() > 1.0) lag_s = std::max(lag_s, std::abs(behind) / kRamp);
  }
  return lag_s;
}

/// Returns the same for a tip that moves at 0.3 m/s and turns at 0.5 rad/s.
double tip_ramp_lag_s(bool with_velocity) {
  const Vector3 v = {0.0, 0.3, 0.0}, w = {0.0, 0.3, 0.4};
  CheckedTip bench;
  double lag_s = 0.0;
  const auto at = [&](double t) {
    TaskSpace::Point point = bench.home;
    point.x.p += t * v;
    point.x.r = exp_so3(t * w) * bench.home.x.r;
    if (with_velocity) point.v << v, w;
    return point;
  };
  while (bench.generator.time_s() < 2.0) {
    assert_int_not_equal(bench.send(at(bench.generator.time_s())), 0);
    bench.cycle();
    bench.report_of(0);
    const Pose now = at(bench.generator.time_s()).x, out = bench.out().x;
    const double behind = (now.p - out.p).norm() / v.norm();
    const double turned = log_so3(now.r * out.r.conjugate()).norm() / w.norm();
    if (bench.generator.time_s() > 1.0) lag_s = std::max({lag_s, behind, turned});
  }
  return lag_s;
}

/// Returns the largest error on a sine of 0.3 rad and 0.5 Hz given in every cycle, rad.
double sine_error(bool with_velocity) {
  CheckedJoints bench;
  double error = 0.0;
  while (bench.generator.time_s() < 5.0) {
    const double phase = kPi * bench.generator.time_s();
    const double dq = with_velocity ? 0.3 * kPi * std::cos(phase) : 0.0;
    assert_int_not_equal(bench.send(point_at(bench, 0.3 * std::sin(phase), dq)), 0);
    bench.cycle();
    bench.report_of(0);
    const double now = 0.3 * std::sin(kPi * bench.generator.time_s());
    if (bench.generator.time_s() > 1.0)
      error = std::max(error, std::abs(bench.out().q[0] - bench.home.q[0] - now));
  }
  return error;
}

struct Following {
  double lag_s = 0.0;           ///< of the velocity's fundamental
  double velocity_error = 0.0;  ///< peak to peak, rad/s
  double slowest = kInfinity;   ///< least velocity where it should exceed half its peak, rad/s
};

/// Follows a noisy sine of 0.3 rad and 0.5 Hz at 30 points per second that arrive up to 5 ms late.
Following follow_sine(bool with_velocity) {
  constexpr double kAmplitude = 0.3, kOmega = 2.0 * kPi * 0.5, kPeak = kAmplitude * kOmega;
  CheckedJoints bench;
  Dice dice{20261125};
  Following result;
  double arrival_s = 0.0, in_phase = 0.0, in_quadrature = 0.0, least = 0.0, most = 0.0;
  int sent = 0;
  while (bench.generator.time_s() < 10.0) {
    const double now_s = bench.generator.time_s();
    if (now_s >= arrival_s) {
      const double t = sent / 30.0;
      // standard deviation 1e-4 rad
      const double noise = std::sqrt(3.0) * 1e-4 * dice.uniform(-1.0, 1.0);
      const double q = kAmplitude * std::sin(kOmega * t) + noise;
      const double dq = with_velocity ? kPeak * std::cos(kOmega * t) : 0.0;
      assert_int_not_equal(bench.send(point_at(bench, q, dq)), 0);
      arrival_s = ++sent / 30.0 + dice.uniform(0.0, 0.005);
    }
    bench.cycle();
    bench.report_of(0);
    if (bench.generator.time_s() <= 2.0) continue;  // four whole periods follow
    const double phase = kOmega * bench.generator.time_s(), dq = bench.out().dq[0];
    const double truth = kPeak * std::cos(phase);
    in_phase += dq * std::cos(phase);
    in_quadrature += dq * std::sin(phase);
    least = std::min(least, dq - truth);
    most = std::max(most, dq - truth);
    if (std::abs(truth) > 0.5 * kPeak)
      result.slowest = std::min(result.slowest, truth > 0.0 ? dq : -dq);
  }
  result.lag_s = std::atan2(in_quadrature, in_phase) / kOmega;
  result.velocity_error = most - least;
  print_message("lag %.4f s, velocity error %.4f rad/s peak to peak, slowest %.4f rad/s\n",
                result.lag_s, result.velocity_error, result.slowest);
  return result;
}

// Proves RG-22.

void positions_in_every_cycle_are_followed_within_20_ms(void**) {
  const double lag_s = ramp_lag_s(false), tip_lag_s = tip_ramp_lag_s(false);
  const double error = sine_error(false);
  print_message("lag %.4f s, of a tip %.4f s, sine %.4f rad\n", lag_s, tip_lag_s, error);
  assert_true(lag_s <= 0.020 && tip_lag_s <= 0.020);
  assert_true(error <= 0.3 * kPi * 0.020);
}

void with_their_velocities_they_are_followed_within_2_ms(void**) {
  const double lag_s = ramp_lag_s(true), tip_lag_s = tip_ramp_lag_s(true);
  const double error = sine_error(true);
  print_message("lag %.4f s, of a tip %.4f s, sine %.4f rad\n", lag_s, tip_lag_s, error);
  assert_true(lag_s <= 0.002 && tip_lag_s <= 0.002);
  assert_true(error <= 0.3 * kPi * 0.002);
}

void thirty_noisy_positions_a_second_are_followed_smoothly(void**) {
  const Following sine = follow_sine(false);
  assert_true(std::abs(sine.lag_s) < 0.005 && sine.velocity_error < 0.1);
  assert_true(sine.slowest > 0.3);  // no standstill at the points
}

void with_velocities_noise_and_delay_are_felt_half(void**) {
  const Following sine = follow_sine(true);
  assert_true(std::abs(sine.lag_s) < 0.0025 && sine.velocity_error < 0.05);
  assert_true(sine.slowest > 0.3);
}

void points_five_times_a_second_with_velocities_do_not_stop_at_each(void**) {
  CheckedJoints bench;
  double slowest = kInfinity;
  for (int k = 0; k < 3000; ++k) {
    const double t = bench.generator.time_s();
    if (k % 200 == 0) assert_int_not_equal(bench.send(point_at(bench, 0.3 * t, 0.3)), 0);
    bench.cycle();
    bench.report_of(0);
    if (t > 1.0) slowest = std::min(slowest, bench.out().dq[0]);
  }
  print_message("slowest %.4f rad/s\n", slowest);
  assert_true(slowest > 0.15);
}

/// Ends a stream that has reached `dq`; asserts that joint 1 comes to rest and never moves back.
void assert_ends_monotone(OnlineMode online, double dq, double period_s) {
  CheckedJoints bench(period_s, online);
  bench.params.timeout_s = 0.05;
  JointSpace::Point begin = point_at(bench, -0.8 * dq, 0.0);
  begin.dq.setZero();
  ASSERT_OK(bench.start(begin));
  const double run_s = 0.5;
  while (bench.generator.time_s() < run_s) {
    const double t = bench.generator.time_s(), faster = std::min(t / 0.4, 1.0);
    const double q = -0.8 * dq + (t < 0.4 ? 0.5 * dq * t * t / 0.4 : dq * (t - 0.2));
    assert_int_not_equal(bench.send(point_at(bench, q, dq * faster)), 0);
    ASSERT_OK(bench.step());
    bench.report_of(0);
  }
  const double last = bench.out().q[0];
  assert_true(bench.out().dq[0] > 0.5 * dq);
  // A forwarded point is held with its velocity until the timeout, without any motion.
  const bool checked = online == OnlineMode::kLimit;
  bench.oracle.forget();
  double farthest = last, back = 0.0;
  for (int k = bench.cycles(3.0); k > 0; --k) {
    checked ? bench.cycle() : ASSERT_OK(bench.step());
    farthest = std::max(farthest, bench.out().q[0]);
    back = std::max(back, farthest - bench.out().q[0]);
  }
  print_message("%.4f rad after the last point, %.4f rad back\n", farthest - last, back);
  ASSERT_NEAR(back, 0.0, 1e-12);
  assert_true(bench.out().standing());
  const double stop = TimeOptimum(axis_limits(0)).stopping_way(dq);
  assert_true(farthest - last <= 1.05 * stop + dq * (bench.params.timeout_s + 4.0 * period_s));
}

void a_stream_that_is_shaped_ends_at_rest_and_never_comes_back(void**) {
  assert_ends_monotone(OnlineMode::kLimit, 2.0, 1e-3);
  assert_ends_monotone(OnlineMode::kLimit, 1.0, 8e-3);
}

void a_stream_that_is_forwarded_ends_at_rest_and_never_comes_back(void**) {
  assert_ends_monotone(OnlineMode::kForward, 2.0, 1e-3);
  assert_ends_monotone(OnlineMode::kForward, 1.0, 8e-3);
}

/// A leader at rest that is elsewhere for `there` points, after `before` of them.
struct Step {
  double size;
  int before, there, period_ms;
  double noise = 0.0;

  double at(int k) const { return k < before || k >= before + there ? 0.0 : size; }
};

/// How far the reference goes outside the step, as fractions of it: behind its beginning, and
/// beyond its end.
template <class Space>
std::array<double, 2> outside_of(const Step& step, bool stamps, Random& random) {
  CheckedMotion<Space> bench;
  std::array<double, 2> outside{};
  for (int k = 0; k < 60; ++k) {
    PointDetails details;
    if (stamps) details.stamp_s = 1e-3 * step.period_ms * k;
    std::uint32_t id = 0;
    const double x = step.at(k) + step.noise * random.uniform(-1.0, 1.0);
    ASSERT_OK(bench.client.send(moved_by(bench.home, x), id, {}, details).status);
    for (int i = 0; i < step.period_ms; ++i) {
      bench.cycle();
      const double share = way(bench.out(), bench.home) / step.size;
      outside = {std::max(outside[0], -share), std::max(outside[1], share - 1.0)};
    }
    bench.report_of(0);
  }
  return outside;
}

// Proves RG-38.

void a_step_or_an_outlier_in_a_stream_never_sends_the_reference_the_other_way(void**) {
  Random random{38};
  constexpr int kForever = 100;
  double beyond = 0.0, back = 0.0, noisy = 0.0;
  for (int trial = trials(100); trial > 0; --trial) {
    const double size = (random.below(2) == 0 ? -1.0 : 1.0) * random.uniform(0.01, 0.25);
    const Step step = {size, 1 + random.below(8), kForever, 4 + random.below(36)};
    const Step outlier = {size, step.before, 1, step.period_ms};
    const Step noise = {0.05, step.before, kForever, step.period_ms, 1e-3};
    for (const bool stamps : {false, true}) {
      for (const auto& outside : {outside_of<JointSpace>(step, stamps, random),
                                  outside_of<TaskSpace>(step, stamps, random)}) {
        assert_true(outside[0] <= 1e-9);
        beyond = std::max(beyond, outside[1]);
      }
      for (const auto& outside : {outside_of<JointSpace>(outlier, stamps, random),
                                  outside_of<TaskSpace>(outlier, stamps, random)}) {
        assert_true(outside[1] <= 1e-9);
        back = std::max(back, outside[0]);
      }
      noisy = std::max(noisy, outside_of<JointSpace>(noise, stamps, random)[1]);
    }
  }
  print_message("a step is passed by up to %.0f %%, its beginning after an outlier by %.0f %%\n",
                100.0 * beyond, 100.0 * back);
  print_message("0.05 rad with 0.001 rad of noise by up to %.3f rad\n", 0.05 * noisy);
  assert_true(beyond <= 0.05 && back <= 0.2);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(positions_in_every_cycle_are_followed_within_20_ms),
      cmocka_unit_test(with_their_velocities_they_are_followed_within_2_ms),
      cmocka_unit_test(thirty_noisy_positions_a_second_are_followed_smoothly),
      cmocka_unit_test(with_velocities_noise_and_delay_are_felt_half),
      cmocka_unit_test(points_five_times_a_second_with_velocities_do_not_stop_at_each),
      cmocka_unit_test(a_stream_that_is_shaped_ends_at_rest_and_never_comes_back),
      cmocka_unit_test(a_stream_that_is_forwarded_ends_at_rest_and_never_comes_back),
      cmocka_unit_test(a_step_or_an_outlier_in_a_stream_never_sends_the_reference_the_other_way),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
