// Tests the limiter of commanded positions: a command within the limits passes unchanged, and no
// output exceeds them.
#include "kernel/guard/position_limiter.hpp"

#include "tests/guard/limiter_cases.hpp"
#include "tests/support/closed_loop.hpp"

namespace tactus {
namespace {

constexpr double kPeriod_s = 1e-3;
constexpr unsigned kSeed = 20260312;

/// Joint 1 of the FER: 2.8973 rad, 2.175 rad/s, 15 rad/s^2.
struct Bench {
  JointLimits limits;
  double dt_s;
  PositionLimiter limiter;

  explicit Bench(double q = 0.0, double period_s = kPeriod_s) : dt_s(period_s) {
    limiter.start(StepLimits::of(limits, 0, dt_s), q);
  }
  double next(double wanted) { return limiter.next(wanted); }
  Watch watch() const { return {limits, 0, dt_s, limiter.sent(), 0.0}; }
};

// Proves GRD-4.

void no_sequence_gets_a_limit_exceeded(void**) {
  print_message("seed %u\n", kSeed);
  for (const double dt_s : kLimitPeriods_s) {
    for (int kind = 0; kind < kHostileKinds; ++kind) {
      std::mt19937_64 bits(kSeed);
      Bench b(2.0, dt_s);
      Watch watch = b.watch();
      for (int k = 0; k < 60000; ++k) {
        const double end = b.limits.q_max[0];
        watch.sees(b.limiter.next(end * hostile(kind, k, b.limiter.sent() / end, bits)));
      }
    }
  }
}

void a_random_mixture_of_attacks_does_not_either(void**) {
  std::mt19937_64 bits(kSeed);
  std::uniform_int_distribution<int> pick(0, kHostileKinds - 1), length(1, 400);
  for (int trial = 0; trial < 20; ++trial) {
    Bench b;
    Watch watch = b.watch();
    for (int k = 0; k < 20000;) {
      const int kind = pick(bits);
      for (int left = length(bits); left > 0; --left, ++k) {
        const double end = b.limits.q_max[0];
        watch.sees(b.limiter.next(end * hostile(kind, k, b.limiter.sent() / end, bits)));
      }
    }
  }
}

void a_wish_beyond_the_limit_ends_on_the_limit_at_rest(void**) {
  for (const double dt_s : kLimitPeriods_s) {
    for (const double sign : {1.0, -1.0}) {
      Bench b(0.0, dt_s);
      for (int k = 0; k * dt_s < 3.0; ++k) {
        const double sent = sign * b.limiter.next(sign * 10.0);
        assert_true(sent <= b.limits.q_max[0]);
      }
      assert_true(b.limiter.sent() == sign * b.limits.q_max[0]);
      assert_true(b.limiter.next(sign * 10.0) == sign * b.limits.q_max[0]);
    }
  }
}

// Proves GRD-5.

/// Duration of the fastest motion over `distance` at the limits of joint 1: v / a + d / v.
double fastest_s(double distance) {
  const double v = 2.175, a = 15.0;
  return distance < v * v / a ? 2.0 * std::sqrt(distance / a) : v / a + distance / v;
}

void a_step_is_travelled_as_fast_as_may_be_without_overshoot(void**) {
  for (const double dt_s : kLimitPeriods_s) {
    for (const double distance : {1e-6, 1e-4, 1e-3, 0.0123, 0.1, 0.5, 2.0}) {
      Bench b(0.0, dt_s);
      int cycles = 0;
      for (; b.limiter.sent() != distance; ++cycles) {
        const double before = b.limiter.sent();
        assert_true(cycles * dt_s < 10.0);
        assert_true(b.limiter.next(distance) <= distance);
        assert_true(b.limiter.sent() > before);
      }
      ASSERT_NEAR(cycles * dt_s, fastest_s(distance), 3.0 * dt_s);
      for (int k = 0; k < 100; ++k) assert_true(b.limiter.next(distance) == distance);
    }
  }
}

void it_comes_to_rest_on_a_constant_wish_whatever_was_wanted_before(void**) {
  std::mt19937_64 bits(kSeed);
  std::uniform_real_distribution<double> any(-2.8, 2.8);
  for (int trial = 0; trial < 300; ++trial) {
    Bench b(0.0, kLimitPeriods_s[trial % 3]);
    for (int k = 0; k < trial; ++k) b.limiter.next(any(bits));
    const double wanted = any(bits);
    int cycles = 0;
    while (b.limiter.next(wanted) != wanted) assert_true(++cycles * b.dt_s < 5.0);
    for (int k = 0; k < 1000; ++k) assert_true(b.limiter.next(wanted) == wanted);
  }
}

void it_joins_a_reference_that_moves_steadily(void**) {
  Bench b;
  int k = 0;
  for (; b.limiter.next(0.5 + 1e-3 * k) != 0.5 + 1e-3 * k; ++k) assert_true(k < 1000);
  while (++k < 1500) assert_true(b.limiter.next(0.5 + 1e-3 * k) == 0.5 + 1e-3 * k);
}

// Proves GRD-6.

void a_motion_at_exactly_all_limits_passes_bit_for_bit(void**) {
  for (const double dt_s : kLimitPeriods_s) {
    Bench b(0.0, dt_s);
    // As far beyond the limit as rounding in a file may be.
    const double end = b.limits.q_max[0] + 0.9 * kPositionAllowance;
    const double v = 2.175, a = 15.0, T = fastest_s(end), ramp = v / a;
    for (int k = 0; k * dt_s < T + 0.1; ++k) {
      const double t = std::min(k * dt_s, T), left = T - t;
      const double wanted = t < ramp      ? 0.5 * a * t * t
                            : left < ramp ? end - 0.5 * a * left * left
                                          : v * (t - 0.5 * ramp);
      assert_true(b.limiter.next(wanted) == wanted);
    }
  }
}

/// Sends a quintic by 0.4 rad on every joint; false if it is refused.
bool send(ClosedLoop& loop, double duration_s) {
  Trajectory<JointSpace>& motion = *loop.client.acquire();
  motion.count = 2;
  motion.fields = kVelocityField | kAccelerationField;
  motion.waypoints[0] = motion.waypoints[1] = {};
  motion.waypoints[0].point.q = loop.plant.initial_q;
  motion.waypoints[1].point.q = loop.plant.initial_q + JointVector::Constant(0.4);
  motion.waypoints[1].time_s = duration_s;
  std::uint32_t id = 0;
  return loop.client.send(motion, id).ok();
}

void what_the_generator_admits_passes_bit_for_bit_its_stops_included(void**) {
  for (const bool cancel : {false, true}) {
    static ClosedLoop loops[2];
    ClosedLoop& loop = loops[cancel];
    loop.plant.friction = 0.0;
    ASSERT_OK(loop.start(1000, 1));
    Guard guard;
    RobotState state;
    state.q = loop.plant.initial_q;
    state.drives.fill({DriveState::kEnabled, true});
    ASSERT_OK(guard.start(loop.pipeline.guard, CommandMode::kPosition, state, kPeriod_s, {}));
    double duration_s = cancel ? 0.8 : 0.2;  // a faster one leaves no room to stop before its end
    while (!send(loop, duration_s)) duration_s *= 1.002;  // close to the shortest admitted
    for (int k = 0; k < 1000; ++k) {
      if (cancel && k == 200) {
        std::uint32_t id = 0;
        assert_true(loop.client.cancel(id).ok());
      }
      ASSERT_OK(loop.run(kPeriod_s));
      RobotCommand command = {CommandMode::kPosition, loop.q_d()};
      ASSERT_OK(guard.limit(state, command));
      assert_true(command.value == loop.q_d());
    }
    assert_int_equal(guard.telemetry().limited_cycles, 0);
    assert_int_equal(guard.telemetry().jerky_cycles, 0);
    const double way = loop.q_d()[0] - loop.plant.initial_q[0];
    assert_true(cancel ? way > 0.01 && way < 0.39 : std::abs(way - 0.4) < 1e-12);
  }
}

// Proves GRD-7.

void a_start_from_rest_in_one_cycle_is_jerky_and_a_smooth_one_is_not(void**) {
  assert_jerky_from<Bench>(7.5e-6);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(no_sequence_gets_a_limit_exceeded),
      cmocka_unit_test(a_random_mixture_of_attacks_does_not_either),
      cmocka_unit_test(a_wish_beyond_the_limit_ends_on_the_limit_at_rest),
      cmocka_unit_test(a_step_is_travelled_as_fast_as_may_be_without_overshoot),
      cmocka_unit_test(it_comes_to_rest_on_a_constant_wish_whatever_was_wanted_before),
      cmocka_unit_test(it_joins_a_reference_that_moves_steadily),
      cmocka_unit_test(a_motion_at_exactly_all_limits_passes_bit_for_bit),
      cmocka_unit_test(what_the_generator_admits_passes_bit_for_bit_its_stops_included),
      cmocka_unit_test(a_start_from_rest_in_one_cycle_is_jerky_and_a_smooth_one_is_not),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
