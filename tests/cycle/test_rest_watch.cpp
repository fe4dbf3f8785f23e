// Tests the watch of rest: against blocks of known velocities, and against swings whose motion is
// known before and after the watch says rest.
#include "kernel/cycle/rest_watch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "kernel/pipeline/settings.hpp"
#include "tests/support/random.hpp"
#include "tests/support/testing.hpp"
#include "tests/support/trials.hpp"

namespace tactus {
namespace {

using Result = RestWatch::Result;

constexpr double kRest = 0.01;  // rad/s
constexpr double kTurn = 6.283185307179586;
constexpr std::uint64_t kSeed = 20261128;
constexpr int kSwings = tries(1000, 100);
constexpr int kPeriods_us[] = {1000, 2000, 8000};

std::uint16_t blocks(int period_us) {
  return static_cast<std::uint16_t>(ExecutiveSection().rest_blocks(period_us));
}

// Proves LAD-4.

/// Adds the same velocity for a whole block and returns the result of its last cycle; the others
/// have none.
Result add_block(RestWatch& watch, double dq) {
  for (int i = 1; i < RestWatch::kCycles; ++i)
    assert_true(watch.add(JointVector::Constant(dq), kRest) == Result::kNothing);
  return watch.add(JointVector::Constant(dq), kRest);
}

void rest_is_blocks_in_a_row_whose_means_are_small_and_is_reported_once(void**) {
  RestWatch watch;
  watch.start(1000, 3);
  assert_true(add_block(watch, 0.0101) == Result::kNothing);
  assert_true(add_block(watch, -0.0101) == Result::kNothing);
  for (int i = 0; i < 2; ++i) assert_true(add_block(watch, -0.0099) == Result::kNothing);
  assert_true(add_block(watch, 0.0101) == Result::kNothing);  // the count begins again
  for (int i = 0; i < 2; ++i) assert_true(add_block(watch, -0.0099) == Result::kNothing);
  assert_false(watch.at_rest() || watch.still());
  assert_true(add_block(watch, -0.0099) == Result::kAtRest);
  assert_true(watch.at_rest() && watch.still());
  assert_true(add_block(watch, 0.0199) == Result::kNothing);
  assert_true(watch.at_rest() && !watch.still());
  assert_true(add_block(watch, -0.0201) == Result::kMoved);
  for (int i = 0; i < 2; ++i) assert_true(add_block(watch, 0.0) == Result::kNothing);
  assert_false(watch.still());
  assert_true(add_block(watch, 0.0) == Result::kNothing);
  assert_true(watch.still());
}

/// Its mean is zero, but it is not at rest.
void a_joint_that_reverses_is_not_at_rest(void**) {
  RestWatch watch;
  watch.start(1000, 1);
  for (int i = 0; i < RestWatch::kCycles; ++i)
    assert_true(watch.add(JointVector::Constant(kRest * (2 * i + 1 - RestWatch::kCycles)), kRest) ==
                Result::kNothing);
  assert_false(watch.still());
}

void a_brake_that_takes_too_long_is_reported_once_and_nan_is_no_rest(void**) {
  RestWatch watch;
  watch.start(55, 1);
  const JointVector dq = JointVector::Constant(std::nan(""));
  for (int i = 1; i < 55; ++i) assert_true(watch.add(dq, kRest) == Result::kNothing);
  assert_true(watch.add(dq, kRest) == Result::kTooLong);
  for (int i = 0; i < 55; ++i) assert_true(watch.add(dq, kRest) == Result::kNothing);
  assert_false(watch.at_rest());
}

/// Blocks of rest that are not enough in a row, and an arm that rests one cycle too late.
void rest_that_is_not_complete_in_time_is_too_late(void**) {
  for (const int leaves : {5, 9, 1000}) {
    RestWatch watch;
    watch.start(99, 10);
    for (int i = 1; i < 99; ++i)
      assert_true(watch.add(JointVector::Constant(i / 10 == leaves ? 1.0 : 0.0), kRest) ==
                  Result::kNothing);
    assert_true(watch.add(JointVector::Zero(), kRest) == Result::kTooLong);
  }
}

// Proves LAD-17.

/// A joint's velocity, rad/s: a swing that decays by `damping` of its critical damping.
struct Swing {
  double amplitude, frequency_hz, phase, damping = 0.0;

  double dq(double time_s) const {
    const double turned = kTurn * frequency_hz * time_s;
    return amplitude * std::exp(-damping * turned) * std::sin(turned + phase);
  }
};

Swing random_swing(Random& random, double slowest_hz) {
  const double amplitude = 0.05 * std::pow(20.0, random.uniform(0.0, 1.0));
  return {amplitude, random.uniform(slowest_hz, 20.0), random.uniform(0.0, kTurn)};
}

/// One joint swings, the others rest.
JointVector swinging(int joint, double dq) {
  JointVector all = JointVector::Zero();
  all[joint] = dq;
  return all;
}

void a_swing_of_a_loop_is_never_rest(void**) {
  Random random = {kSeed};
  for (const int period_us : kPeriods_us) {
    for (int n = 0; n < kSwings; ++n) {
      const Swing swing = random_swing(random, 1.0);
      const int joint = random.below(kDof);
      RestWatch watch;
      watch.start(1'000'000, blocks(period_us));
      for (int k = 0; k * 1e-6 * period_us < 3.0; ++k) {
        const JointVector dq = swinging(joint, swing.dq(k * 1e-6 * period_us));
        if (watch.add(dq, kRest) == Result::kNothing && !watch.still()) continue;
        print_error("%d us, %g rad/s, %g Hz, phase %g\n", period_us, swing.amplitude,
                    swing.frequency_hz, swing.phase);
        assert_true(false);
      }
    }
  }
}

/// The largest mean of as many samples as a block has, from any sample after `begin` on.
double fastest_mean(const Swing& swing, double period_s, int begin) {
  double largest = 0.0;
  const double decayed_s = 7.0 / (swing.damping * kTurn * swing.frequency_hz);  // to a thousandth
  for (int k = begin; (k - begin) * period_s < decayed_s; ++k) {
    double sum = 0.0;
    for (int i = k; i < k + RestWatch::kCycles; ++i) sum += swing.dq(i * period_s);
    largest = std::max(largest, std::abs(sum) / RestWatch::kCycles);
  }
  return largest;
}

/// A block whose length is half a period of the swing can have a mean of zero in each of a row, and
/// later have one of 2/pi of the amplitude, at most four times the limit.
bool fits_the_block(const Swing& swing, double period_s) {
  const double halves = 2.0 * RestWatch::kCycles * period_s * swing.frequency_hz;
  return halves > 0.7 && halves < 1.3;
}

/// Swings from 2.1 Hz on: slower ones can be as slow as rest for a whole window.
void what_remains_of_a_swing_after_rest_has_not_moved(void**) {
  Random random = {kSeed};
  for (const int period_us : kPeriods_us) {
    const double period_s = 1e-6 * period_us;
    for (int n = 0; n < kSwings; ++n) {
      Swing swing = random_swing(random, 2.1);
      swing.damping = 0.005 * std::pow(60.0, random.uniform(0.0, 1.0));
      const bool fits = fits_the_block(swing, period_s);
      RestWatch watch;
      watch.start(1'000'000, blocks(period_us));
      int k = 0;
      while (watch.add(swinging(n % kDof, swing.dq(k++ * period_s)), kRest) != Result::kAtRest)
        assert_true(k < 500'000);
      const double mean = fastest_mean(swing, period_s, k);
      if (mean <= (fits ? 3.0 : RestWatch::kMoved) * kRest) continue;
      print_error("%d us, %g rad/s, %g Hz, damping %g: at rest after %d cycles, then %g rad/s\n",
                  period_us, swing.amplitude, swing.frequency_hz, swing.damping, k, mean);
      assert_true(false);
    }
  }
}

/// Noise whose standard deviation is the limit: what is judged are means, not samples.
void noise_of_a_resting_arm_is_rest(void**) {
  std::mt19937_64 random(kSeed);
  std::normal_distribution<double> noise(0.0, kRest);
  for (const int period_us : kPeriods_us) {
    for (int n = 0; n < 100; ++n) {
      RestWatch watch;
      watch.start(1'000'000, blocks(period_us));
      int cycles = 0;
      JointVector dq;
      do {
        for (double& each : dq) each = noise(random);
        ++cycles;
      } while (watch.add(dq, kRest) != Result::kAtRest);
      assert_true(cycles * period_us >= 100'000 && cycles * period_us < 1'000'000);
    }
  }
}

void rest_lasts_whole_blocks(void**) {
  constexpr struct {
    int rest_ms, period_us, cycles;
  } kCases[] = {{100, 1000, 100}, {100, 2000, 50},       {100, 8000, 20}, {101, 1000, 110},
                {1, 1000, 10},    {60000, 100, 600'000}, {80, 8000, 10}};
  for (const auto& it : kCases) {
    ExecutiveSection settings;
    settings.rest_ms = it.rest_ms;
    RestWatch watch;
    watch.start(1'000'000, static_cast<std::uint16_t>(settings.rest_blocks(it.period_us)));
    for (int i = 1; i < it.cycles; ++i)
      assert_true(watch.add(JointVector::Zero(), kRest) == Result::kNothing);
    assert_true(watch.add(JointVector::Zero(), kRest) == Result::kAtRest);
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(rest_is_blocks_in_a_row_whose_means_are_small_and_is_reported_once),
      cmocka_unit_test(a_joint_that_reverses_is_not_at_rest),
      cmocka_unit_test(a_brake_that_takes_too_long_is_reported_once_and_nan_is_no_rest),
      cmocka_unit_test(rest_that_is_not_complete_in_time_is_too_late),
      cmocka_unit_test(a_swing_of_a_loop_is_never_rest),
      cmocka_unit_test(what_remains_of_a_swing_after_rest_has_not_moved),
      cmocka_unit_test(noise_of_a_resting_arm_is_rest),
      cmocka_unit_test(rest_lasts_whole_blocks),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
