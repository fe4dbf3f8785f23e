// Tests Histogram: counts and extremes are exact, percentiles are accurate to 3 %.
#include "kernel/core/histogram.hpp"

#include <algorithm>
#include <random>
#include <thread>

#include "kernel/pipeline/timing.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr double kPromised = 0.03;  // of the value
constexpr unsigned kSeed = 20260303;
constexpr std::uint64_t kHuge = UINT32_MAX;  // the longest value with its own bucket

// Proves EXE-7.

void an_empty_histogram_is_all_zero(void**) {
  const Histogram times;
  assert_int_equal(times.count(), 0);
  assert_int_equal(times.last(), 0);
  assert_int_equal(times.min(), 0);
  assert_int_equal(times.max(), 0);
  assert_true(times.mean() == 0.0);
  for (const double fraction : {0.0, 0.5, 1.0}) assert_true(times.percentile(fraction) == 0.0);
}

void count_extremes_mean_and_last_are_exact(void**) {
  Histogram times;
  for (const std::uint64_t value : {300, 100, 800}) times.add(value);
  assert_int_equal(times.count(), 3);
  assert_int_equal(times.min(), 100);
  assert_int_equal(times.max(), 800);
  assert_int_equal(times.last(), 800);
  assert_true(times.mean() == 400.0);
}

void a_single_value_is_every_percentile(void**) {
  for (const std::uint64_t value : {std::uint64_t{0}, std::uint64_t{65}, kHuge}) {
    Histogram times;
    times.add(value);
    for (const double fraction : {0.0, 0.5, 1.0})
      assert_true(times.percentile(fraction) == static_cast<double>(value));
  }
}

/// The median of {0, value, value, kHuge}: neither extreme can hide a wrong bucket.
double median_among_others(std::uint64_t value) {
  Histogram times;
  for (const std::uint64_t added : {std::uint64_t{0}, value, value, kHuge}) times.add(added);
  return times.percentile(0.5);
}

void values_below_32_ns_are_exact(void**) {
  for (std::uint64_t value = 0; value < 32; ++value)
    assert_true(median_among_others(value) == static_cast<double>(value));
}

void next_to_every_power_of_two_the_error_is_as_promised(void**) {
  for (std::uint64_t power = 32; power <= std::uint64_t{1} << 25; power *= 2) {
    for (const std::uint64_t value : {power - 1, power, power + 1, power + power / 2}) {
      const double exact = static_cast<double>(value);
      ASSERT_NEAR(median_among_others(value), exact, kPromised * exact);
    }
  }
}

void what_is_longer_than_67_ms_shows_as_saturated_and_its_percentile_is_the_longest(void**) {
  constexpr std::uint64_t kLast = (std::uint64_t{1} << 26) - 1;
  Histogram times;
  for (const std::uint64_t value : {std::uint64_t{1}, kLast}) times.add(value);
  assert_int_equal(times.saturated(), 0);
  for (const std::uint64_t value : {kLast + 1, std::uint64_t{1} << 31, UINT64_MAX})
    times.add(value);
  assert_int_equal(times.saturated(), 3);
  assert_int_equal(times.count(), 5);
  assert_true(times.percentile(0.9) == static_cast<double>(kHuge));
  assert_true(times.max() == kHuge && times.last() == kHuge);
}

void percentiles_are_those_of_the_sorted_values(void**) {
  static std::array<std::uint64_t, 100000> sorted;
  print_message("seed %u\n", kSeed);
  std::mt19937_64 bits(kSeed);
  std::uniform_real_distribution<double> exponent(0.0, 7.8);  // 1 ns to 63 ms
  Histogram times;
  for (std::uint64_t& value : sorted) {
    value = static_cast<std::uint64_t>(std::pow(10.0, exponent(bits)));
    times.add(value);
  }
  std::sort(sorted.begin(), sorted.end());
  for (const std::size_t part : {0, 1, 10, 1000, 2500, 5000, 7500, 9000, 9900, 9990, 9999, 10000}) {
    const std::size_t rank = std::max<std::size_t>(part * sorted.size() / 10000, 1);
    const double exact = static_cast<double>(sorted[rank - 1]);
    const double fraction = static_cast<double>(part) / 10000.0;
    ASSERT_NEAR(times.percentile(fraction), exact, kPromised * exact);
  }
}

// Proves LAD-9.

void all_times_of_a_cycle_fit_a_third_of_a_small_microcontroller(void**) {
  assert_true(sizeof(Histogram) <= 1700);
  assert_true(sizeof(Timing) <= 43 * 1024);
}

void a_reader_in_another_thread_sees_counts_that_grow_and_values_that_were_added(void**) {
  static Histogram times;
  constexpr std::uint32_t kAdded = 200000;
  std::thread writer([] {
    for (std::uint32_t i = 0; i < kAdded; ++i) times.add(1000 + i % 1000);
  });
  bool sound = true;
  for (std::uint32_t before = 0, count = 0; before < kAdded; before = count) {
    count = times.count();
    const double median = times.percentile(0.5), mean = times.mean();
    sound = sound && count >= before;
    sound = sound && (median == 0.0 || (median > 970.0 && median < 2060.0));
    sound = sound && (count == 0 || (mean >= 1000.0 && mean <= 2000.0));
  }
  writer.join();
  assert_true(sound);
  assert_int_equal(times.count(), kAdded);
}

// Proves EXE-7.

void percentiles_stay_between_the_extremes_and_grow_with_the_fraction(void**) {
  Histogram times;
  times.add(65);
  times.add(1000);
  times.add(1001);
  times.add(70000);
  double before = static_cast<double>(times.min());
  for (int hundredth = 0; hundredth <= 100; ++hundredth) {
    const double value = times.percentile(hundredth / 100.0);
    assert_true(value >= before);
    before = value;
  }
  assert_true(before <= static_cast<double>(times.max()));
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(an_empty_histogram_is_all_zero),
      cmocka_unit_test(count_extremes_mean_and_last_are_exact),
      cmocka_unit_test(a_single_value_is_every_percentile),
      cmocka_unit_test(values_below_32_ns_are_exact),
      cmocka_unit_test(next_to_every_power_of_two_the_error_is_as_promised),
      cmocka_unit_test(
          what_is_longer_than_67_ms_shows_as_saturated_and_its_percentile_is_the_longest),
      cmocka_unit_test(percentiles_are_those_of_the_sorted_values),
      cmocka_unit_test(all_times_of_a_cycle_fit_a_third_of_a_small_microcontroller),
      cmocka_unit_test(a_reader_in_another_thread_sees_counts_that_grow_and_values_that_were_added),
      cmocka_unit_test(percentiles_stay_between_the_extremes_and_grow_with_the_fraction),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
