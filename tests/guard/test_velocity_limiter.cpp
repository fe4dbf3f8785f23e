// Tests the limiter of commanded velocities: a command within the limits passes unchanged, and no
// output exceeds them.
#include "kernel/guard/velocity_limiter.hpp"

#include "tests/guard/limiter_cases.hpp"

namespace tactus {
namespace {

constexpr double kPeriod_s = 1e-3;
constexpr unsigned kSeed = 20260313;

/// Joint 1 of the FER (2.8973 rad, 2.175 rad/s, 15 rad/s^2), which follows its command at once.
struct Bench {
  JointLimits limits;
  double dt_s, q, sent = 0.0;
  VelocityLimiter limiter;

  explicit Bench(double start_q = 0.0, double period_s = kPeriod_s, double dq = 0.0)
      : dt_s(period_s), q(start_q) {
    limiter.start(StepLimits::of(limits, 0, dt_s), dt_s, dq);
  }
  double next(double wanted) {
    sent = limiter.next(wanted, q);
    q += dt_s * sent;
    return sent;
  }
};

// Proves GRD-4.

void no_sequence_gets_a_limit_exceeded(void**) {
  print_message("seed %u\n", kSeed);
  for (const double dt_s : kLimitPeriods_s) {
    for (int kind = 0; kind < kHostileKinds; ++kind) {
      std::mt19937_64 bits(kSeed);
      Bench b(2.0, dt_s);
      Watch watch(b.limits, 0, dt_s, b.q, 0.0);
      for (int k = 0; k < 60000; ++k) {
        b.next(3.0 * hostile(kind, k, b.q / b.limits.q_max[0], bits));
        watch.sees(b.q);
      }
    }
  }
}

void full_speed_towards_the_limit_ends_at_rest_before_it(void**) {
  for (const double dt_s : kLimitPeriods_s) {
    for (const double sign : {1.0, -1.0}) {
      Bench b(0.0, dt_s);
      for (int k = 0; k * dt_s < 3.0; ++k) b.next(sign * 10.0);
      ASSERT_NEAR(b.q, sign * b.limits.q_max[0], 2.0 * kPositionAllowance);
      ASSERT_NEAR(b.sent, 0.0, 1e-9);
    }
  }
}

void a_robot_that_lags_passes_the_limit_by_no_more_than_lag_times_speed(void**) {
  for (const int lag : {1, 5, 20}) {
    Bench b;
    double past[32] = {};
    double farthest = 0.0;
    for (int k = 0; k < 4000; ++k) {
      past[k % 32] = b.limiter.next(10.0, b.q);
      b.q += kPeriod_s * past[(k + 32 - lag) % 32];
      farthest = std::max(farthest, b.q);
    }
    assert_true(farthest - b.limits.q_max[0] <= lag * kPeriod_s * b.limits.dq_max[0] + 1e-8);
  }
}

// Proves GRD-5.

void a_constant_wish_is_reached_as_fast_as_may_be_and_kept(void**) {
  for (const double wanted : {1.0, -2.175, 1e-6}) {
    Bench b;
    int cycles = 0;
    for (; b.next(wanted) != wanted; ++cycles) assert_true(cycles < 1000);
    ASSERT_NEAR(cycles * kPeriod_s, std::abs(wanted) / 15.0, 2.0 * kPeriod_s);
    for (int k = 0; k < 500; ++k) assert_true(b.next(wanted) == wanted);
  }
}

void it_begins_at_the_measured_velocity(void**) {
  Bench b(0.0, kPeriod_s, 1.0);
  assert_true(b.next(1.0) == 1.0);
  b = Bench(0.0, kPeriod_s, 1.0);
  ASSERT_NEAR(b.next(0.0), 1.0 - 15.0 * kPeriod_s, 1e-7);
}

// Proves GRD-6.

void a_motion_at_exactly_all_limits_passes_bit_for_bit(void**) {
  for (const double dt_s : kLimitPeriods_s) {
    const double v = 2.175, a = 15.0;
    const int ramp = static_cast<int>(v / a / dt_s);
    Bench b(0.0, dt_s);
    // Accelerates, cruises, brakes; the distance is chosen so that the motion ends at the limit.
    const int along = static_cast<int>((b.limits.q_max[0] - ramp * a * dt_s * dt_s * ramp) /
                                       (ramp * a * dt_s * dt_s));
    b.q = b.limits.q_max[0] - (ramp + along) * ramp * a * dt_s * dt_s;
    for (int k = 1; k <= 2 * ramp + along; ++k) {
      const int level = std::min({k, ramp, 2 * ramp + along - k});
      const double wanted = level * a * dt_s;
      assert_true(b.next(wanted) == wanted);
    }
    ASSERT_NEAR(b.q, b.limits.q_max[0], 1e-9);
  }
}

// Proves GRD-7.

void a_start_from_rest_in_one_cycle_is_jerky_and_a_smooth_one_is_not(void**) {
  assert_jerky_from<Bench>(7.5e-3);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(no_sequence_gets_a_limit_exceeded),
      cmocka_unit_test(full_speed_towards_the_limit_ends_at_rest_before_it),
      cmocka_unit_test(a_robot_that_lags_passes_the_limit_by_no_more_than_lag_times_speed),
      cmocka_unit_test(a_constant_wish_is_reached_as_fast_as_may_be_and_kept),
      cmocka_unit_test(it_begins_at_the_measured_velocity),
      cmocka_unit_test(a_motion_at_exactly_all_limits_passes_bit_for_bit),
      cmocka_unit_test(a_start_from_rest_in_one_cycle_is_jerky_and_a_smooth_one_is_not),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
