// The steering of the frames by the reference clock, and the clocks of the slaves after a start-up.
#include "hal/ethercat/segment_clock.hpp"
#include "tests/hal/ethercat/master_bench.hpp"
#include "tests/support/random.hpp"

namespace tactus::ethercat {
namespace {

constexpr std::int64_t kPeriod_ns = 1'000'000;

/// Sends frames by a host clock that runs `drift` faster than the reference, woken late by up to
/// `jitter_ns`. Returns the largest phase error of the second half, ns.
double largest_error(double drift, int jitter_ns, int lost_every = 0) {
  ClockSteer steer;
  steer.start(kPeriod_ns);
  Random random{7};
  double host_ns = 0.0, largest = 0.0;
  for (int k = 0; k < 20000; ++k) {
    host_ns += static_cast<double>(kPeriod_ns + steer.correction());
    const double late_ns = jitter_ns > 0 ? random.below(jitter_ns) : 0.0;
    const auto reference = static_cast<std::int64_t>((host_ns + late_ns) / (1.0 + drift));
    if (lost_every == 0 || k % lost_every != 0) steer.take(reference + 123'456'789);
    if (k > 10000) largest = std::max(largest, std::abs(static_cast<double>(steer.error())));
  }
  return largest;
}

// Proves ECAT-10.
void frames_are_sent_in_step_with_the_reference_clock(void**) {
  assert_true(largest_error(0.0, 0) < 2.0);
  assert_true(largest_error(100e-6, 0) < 50.0);
  assert_true(largest_error(-100e-6, 0) < 50.0);
}

void late_wake_ups_and_lost_frames_do_not_drive_the_frames_away(void**) {
  assert_true(largest_error(50e-6, 50'000) < 60'000.0);
  assert_true(largest_error(50e-6, 0, 7) < 1000.0);
}

void a_correction_is_bounded(void**) {
  ClockSteer steer;
  steer.start(kPeriod_ns);
  steer.take(0);
  for (int k = 0; k < 1000; ++k) {
    steer.take(400'000);
    assert_true(std::abs(steer.correction()) <= 20'000);
  }
  assert_true(steer.correction() < 0);  // it is too late
}

/// They run 25 ppm fast and slow, and were far apart when power came on.
void the_clocks_of_all_slaves_show_the_same_time(void**) {
  static MasterBench bench;
  bench.ethercat.clock_frames = 4000;
  bench.plant.drift_ppb = 25'000;
  ASSERT_OK(bench.load());
  ASSERT_OK(bench.start());
  ASSERT_OK(bench.cycles(500));
  for (int i = 1; i < kDof; ++i) {
    // Delays of 500 ns from slave to slave are part of it.
    assert_int_equal(bench.hal.line.slave(i).esc().clock().delay(), 500 * i);
    assert_true(std::abs(bench.hal.line.slave(i).esc().clock().difference()) < 1000);
  }
}

}  // namespace
}  // namespace tactus::ethercat

int main() {
  using namespace tactus::ethercat;
  const CMUnitTest tests[] = {
      cmocka_unit_test(frames_are_sent_in_step_with_the_reference_clock),
      cmocka_unit_test(late_wake_ups_and_lost_frames_do_not_drive_the_frames_away),
      cmocka_unit_test(a_correction_is_bounded),
      cmocka_unit_test(the_clocks_of_all_slaves_show_the_same_time),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
