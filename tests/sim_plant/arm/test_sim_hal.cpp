// Tests the simulated plant through the Hal: connection, measurement, noise and commands.
#include <algorithm>

#include "tests/sim_plant/arm/sim_hal_bench.hpp"

namespace tactus {
namespace {

using Bench = SimHalBench;

// Proves SIM-4.

void a_period_that_is_not_offered_is_refused(void**) {
  Bench& b = g_bench;
  ASSERT_OK(b.hal.load(PlantParams(), 1));
  b.hal.set_period(kPeriod_s);
  for (const double period_s : {0.0, 99e-6, 10001e-6, std::nan("")}) {
    b.hal.set_period(period_s);
    ASSERT_STATUS(b.hal.connect(kEffort), Status::kNotOffered);
  }
  for (const int period_us : {100, 10000}) {
    b.hal.set_period(period_us * 1e-6);
    ASSERT_OK(b.hal.connect(kEffort));
  }
}

void without_a_connection_nothing_is_measured_and_nothing_is_taken(void**) {
  static SimHal hal;
  RobotState state;
  hal.set_period(kPeriod_s);
  static_cast<void>(hal.disconnect());
  ASSERT_STATUS(hal.connect(kEffort), Status::kNotStarted);
  ASSERT_OK(hal.load(PlantParams(), 1));
  ASSERT_STATUS(measure(hal, state), Status::kNotStarted);
  ASSERT_STATUS(hal.write({kEffort}), Status::kNotStarted);
}

void commanding_the_torque_found_at_the_start_moves_nothing(void**) {
  Bench& b = g_bench;
  PlantParams params;
  params.friction = 0.0;
  params.rotor_inertia.setZero();
  params.payload_kg = 3.0;
  params.payload_com = Vector3(0.1, 0.0, 0.05);
  b.start(params);
  for (int k = 0; k < 1000; ++k) b.cycle(JointVector::Zero());
  ASSERT_NEAR((b.hal.arm().q() - params.initial_q).norm(), 0.0, 1e-12);
  assert_true(b.hold.norm() > 10.0);
}

// Proves SIM-2.

void each_write_holds_the_torque_for_one_period(void**) {
  static Arm arm;
  Bench& b = g_bench;
  ASSERT_OK(arm.load(PlantParams()));
  b.start(PlantParams());
  const std::int64_t start_ns = b.hal.time_ns();
  arm.stand();
  for (int k = 0; k < 100; ++k) {
    b.cycle(wave(k));
    arm.step(b.hold + wave(k), kPeriod_s);
  }
  ASSERT_OK(measure(b.hal, b.state));
  assert_true(same_bytes(b.state.q, arm.q()));
  assert_true(same_bytes(b.state.dq, arm.dq()));
  assert_true(same_bytes(b.state.tau, b.hold + wave(99)));
  assert_int_equal(b.hal.time_ns() - start_ns, 100 * 1000 * 1000);
}

void the_measured_state_is_late_by_the_cycles_stated(void**) {
  Bench& b = g_bench;
  static RobotState truth[40];  // of each cycle
  for (int delay = 0; delay <= kMaxDelayCycles; ++delay) {
    PlantParams params;
    params.delay_cycles = delay;
    b.start(params);
    for (int k = 0; k < 40; ++k) {
      truth[k].q = b.hal.arm().q();
      truth[k].dq = b.hal.arm().dq();
      truth[k].tau = b.hold + wave(k);
      b.cycle(wave(k + 1));  // reads, then moves on
      const RobotState& then = truth[std::max(k - delay, 0)];
      assert_true(same_bytes(b.state.q, then.q) && same_bytes(b.state.dq, then.dq));
      assert_true(same_bytes(b.state.tau, then.tau));
      if (k >= delay) assert_int_equal(b.hal.time_ns() - b.state.stamp_ns, (delay + 1) * 1000000);
    }
  }
}

void the_noise_has_no_mean_and_the_deviation_stated(void**) {
  Bench& b = g_bench;
  constexpr int kCycles = 4000;
  const double n = kCycles * kDof;
  b.start(noisy());
  double q_sum = 0.0, dq_sum = 0.0, q_squares = 0.0, dq_squares = 0.0, product = 0.0;
  for (int k = 0; k < kCycles; ++k) {
    const JointVector true_q = b.hal.arm().q(), true_dq = b.hal.arm().dq();
    b.cycle(JointVector::Zero());
    const JointVector q = (b.state.q - true_q) / 1e-4, dq = (b.state.dq - true_dq) / 1e-2;
    q_sum += q.sum();
    dq_sum += dq.sum();
    product += q.dot(dq);
    q_squares += q.squaredNorm();
    dq_squares += dq.squaredNorm();
  }
  // Four standard errors of the estimates from n numbers.
  for (const double sum : {q_sum, dq_sum, product}) ASSERT_NEAR(sum / n, 0.0, 4.0 / std::sqrt(n));
  for (const double squares : {q_squares, dq_squares})
    ASSERT_NEAR(std::sqrt(squares / n), 1.0, 4.0 / std::sqrt(2.0 * n));
}

void reading_twice_measures_once(void**) {
  Bench& b = g_bench;
  RobotState again;
  b.start(noisy());
  ASSERT_OK(measure(b.hal, b.state));
  ASSERT_OK(measure(b.hal, again));
  assert_true(same_bytes(b.state.q, again.q) && same_bytes(b.state.dq, again.dq));
}

// Proves SIM-3.

void the_same_seed_gives_the_same_bytes_and_another_only_other_noise(void**) {
  for (const std::uint64_t seed : {7u, 8u}) {
    g_bench.start(noisy(), 7);
    g_twin.start(noisy(), seed);
    g_twin.hold = g_bench.hold;
    for (int k = 0; k < 200; ++k) {
      g_bench.cycle(wave(k));
      g_twin.cycle(wave(k));
      assert_true(same_bytes(g_bench.state.q, g_twin.state.q) == (seed == 7));
      assert_true(same_bytes(g_bench.state.dq, g_twin.state.dq) == (seed == 7));
      assert_true(same_bytes(g_bench.hal.arm().q(), g_twin.hal.arm().q()));
    }
  }
}

// Proves SIM-4.

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_period_that_is_not_offered_is_refused),
      cmocka_unit_test(without_a_connection_nothing_is_measured_and_nothing_is_taken),
      cmocka_unit_test(commanding_the_torque_found_at_the_start_moves_nothing),
      cmocka_unit_test(each_write_holds_the_torque_for_one_period),
      cmocka_unit_test(the_measured_state_is_late_by_the_cycles_stated),
      cmocka_unit_test(the_noise_has_no_mean_and_the_deviation_stated),
      cmocka_unit_test(reading_twice_measures_once),
      cmocka_unit_test(the_same_seed_gives_the_same_bytes_and_another_only_other_noise),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
