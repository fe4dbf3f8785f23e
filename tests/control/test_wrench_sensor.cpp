// The wrench front end and the sensor itself: its bias and its faults.
#include "tests/control/wrench_bench.hpp"

namespace tactus {
namespace {

// Proves WF-2.

void until_the_tare_is_done_the_wrench_is_zero_and_the_flag_says_so(void**) {
  WrenchBench bench;
  ASSERT_OK(bench.front.start());
  for (int i = 1; i <= 100; ++i) {
    assert_true(bench.front.taring.value);
    bench.bias[0] = i % 2 ? 3.4 : 2.6;  // noise within the tolerance
    bench.feel(kNone);
    ASSERT_OK(bench.front.step(kPeriod_s));
    assert_same(bench.front.h.value, kNone, 0.0);
  }
  assert_false(bench.front.taring.value);
  ASSERT_NEAR(bench.front.bias.value[0], 3.0, 1e-12);
}

void the_tare_takes_the_same_time_at_every_period(void**) {
  for (const int period_ms : {1, 2, 8}) {
    WrenchBench bench;
    bench.front.params.tare_s = 0.4;
    ASSERT_OK(bench.front.start());
    ASSERT_OK(bench.run(400 / period_ms - 1, 1e-3 * period_ms));
    assert_true(bench.front.taring.value);
    ASSERT_OK(bench.run(1, 1e-3 * period_ms));
    assert_false(bench.front.taring.value);
  }
}

void a_bump_begins_the_tare_anew_and_is_not_in_the_bias(void**) {
  for (const int component : {0, 5}) {
    WrenchBench bench;
    ASSERT_OK(bench.front.start());
    ASSERT_OK(bench.run(80));
    bench.ft[component] += component < 3 ? 2.1 : 0.21;
    ASSERT_OK(bench.run(1));
    bench.feel(kNone);
    ASSERT_OK(bench.run(99));
    assert_true(bench.front.taring.value);
    ASSERT_OK(bench.run(1));
    assert_false(bench.front.taring.value);
    assert_same(bench.front.bias.value, bench.bias, 1e-12);
  }
}

/// Each step is far below the tolerance, but their sum over the interval is not.
void a_signal_that_drifts_or_never_rests_stops_the_robot(void**) {
  WrenchBench bench;
  ASSERT_OK(bench.front.start());
  for (int i = 1; i < 1000; ++i) {
    bench.ft[1] = 0.05 * i;  // 5 N in a tare's time
    ASSERT_OK(bench.front.step(kPeriod_s));
    assert_same(bench.front.h.value, kNone, 0.0);
  }
  ASSERT_STATUS(bench.front.step(kPeriod_s), Status::kSensorNotSteady);
}

void a_restart_tares_anew(void**) {
  WrenchBench bench;
  bench.tare();
  bench.bias = wrench({-1.0, 2.0, 4.0}, {0.1, 0.2, 0.3});
  bench.turn();
  bench.feel(kNone);
  ASSERT_OK(bench.front.start());
  assert_same(bench.front.h.value, kNone, 0.0);
  assert_same(bench.front.bias.value, kNone, 0.0);
  ASSERT_OK(bench.run(100));
  assert_same(bench.front.bias.value, bench.bias, 1e-12);
  for (int i = 0; i < 11; ++i) {  // tares cut short, together longer than the timeout
    ASSERT_OK(bench.front.start());
    ASSERT_OK(bench.run(99));
    assert_true(bench.front.taring.value);
  }
}

// Proves WF-4.

void a_reading_or_pose_that_is_not_finite_stops_the_robot(void**) {
  for (const double bad : {std::nan(""), kInfinity, -kInfinity})
    for (int i = 0; i < 10; ++i) {
      WrenchBench bench, begun;
      begun.tare();
      for (WrenchBench* b : {&bench, &begun}) {
        (i < 6 ? b->ft[i] : b->x.r.coeffs()[i - 6]) = bad;
        if (i < 6) ASSERT_STATUS(b->front.start(), Status::kSensorNotFinite);
      }
      ASSERT_STATUS(begun.front.step(kPeriod_s), Status::kSensorNotFinite);
    }
}

void a_reading_at_the_end_of_the_range_stops_the_robot(void**) {
  for (int i = 0; i < 6; ++i) {
    WrenchBench bench;
    bench.tare();
    bench.ft = kNone;
    bench.ft[i] = i < 3 ? -299.0 : 29.9;
    ASSERT_OK(bench.front.step(kPeriod_s));
    bench.ft[i] = i < 3 ? -300.0 : 30.0;  // a clipped sensor reads this
    ASSERT_STATUS(bench.front.step(kPeriod_s), Status::kSensorRange);
    ASSERT_STATUS(bench.front.start(), Status::kSensorRange);
  }
}

/// A sensor of 100 Hz read at 1 kHz repeats every reading ten times; that is not stuck.
void a_reading_that_stays_the_same_to_the_last_bit_is_stuck(void**) {
  WrenchBench bench;
  bench.front.params.stuck_s = 0.05;
  ASSERT_OK(bench.front.start());
  for (int i = 0; i < 500; ++i) {
    bench.ft[2] = 11.0 + 1e-9 * (i / 10);
    ASSERT_OK(bench.front.step(kPeriod_s));
  }
  ASSERT_OK(bench.run(40));
  ASSERT_STATUS(bench.run(20), Status::kSensorStuck);
  for (int i = 0; i < 2; ++i) {  // a restart begins the count again
    ASSERT_OK(bench.front.start());
    ASSERT_OK(bench.run(40));
  }

  WrenchBench unwatched;  // a simulated sensor without noise
  unwatched.tare();
  ASSERT_OK(unwatched.run(20000));
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(until_the_tare_is_done_the_wrench_is_zero_and_the_flag_says_so),
      cmocka_unit_test(the_tare_takes_the_same_time_at_every_period),
      cmocka_unit_test(a_bump_begins_the_tare_anew_and_is_not_in_the_bias),
      cmocka_unit_test(a_signal_that_drifts_or_never_rests_stops_the_robot),
      cmocka_unit_test(a_restart_tares_anew),
      cmocka_unit_test(a_reading_or_pose_that_is_not_finite_stops_the_robot),
      cmocka_unit_test(a_reading_at_the_end_of_the_range_stops_the_robot),
      cmocka_unit_test(a_reading_that_stays_the_same_to_the_last_bit_is_stuck),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
