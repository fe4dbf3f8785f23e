// The way through the targets of chunks: without delay, over seams, to the end.
#include "tests/streams/chunk_bench.hpp"
#include "tests/support/testing.hpp"

namespace {

using namespace tactus;

double sine(double t) {
  return 0.2 * std::sin(2.0 * t);
}

// Proves RG-26, RG-29.

/// A policy of 30 targets at 30 Hz every 0.3 s, 0.15 s late, whose chunks agree.
template <class Space>
void agreeing_chunks_add_no_delay(double period_s) {
  ChunkBench<Space> bench(period_s);
  const int every = bench.cycles(0.3), late = bench.cycles(0.15);
  double worst = 0.0, behind = 0.0, ahead = 0.0;
  int standing = 0, longest = 0;
  for (int k = 0; k < bench.cycles(12.0); ++k) {
    if (k >= late && (k - late) % every == 0)
      bench.send_targets((k - late) * period_s, 1.0 / 30.0, 30, bench.signal);
    bench.cycle();
    const double t = bench.now_s();
    if (t < 2.0) continue;
    const double x = bench.way_now();
    worst = std::max(worst, std::abs(x - bench.signal(t)));
    behind += std::pow(x - bench.signal(t - period_s), 2);
    ahead += std::pow(x - bench.signal(t), 2);
    const bool stands =
        std::abs(speed(bench.out())) < 0.02 && std::abs(bench.signal_speed(t)) > 0.2;
    standing = stands ? standing + 1 : 0;
    longest = std::max(longest, standing);
  }
  assert_true(ahead < behind);  // nearer to the signal now than to that of a cycle ago
  assert_true(worst < 3e-4);
  assert_int_equal(longest, 0);
  assert_int_equal(bench.starved, 0);
}
void agreeing_chunks_add_no_delay_and_no_standstill(void**) {
  for (const double period_s : {1e-3, 2e-3, 8e-3}) {
    agreeing_chunks_add_no_delay<JointSpace>(period_s);
    agreeing_chunks_add_no_delay<TaskSpace>(period_s);
  }
}

// Proves RG-28.

/// Without a successor the reference comes to rest at the last target, never turns back, and this
/// is told before; a later chunk goes on from there.
template <class Space>
void starves() {
  ChunkBench<Space> bench;
  bench.chunk.sequence = 0;
  const auto line = [](double t) { return 0.3 * t * t / (0.5 + t); };
  const std::uint32_t id = bench.send_targets(0.0, 1.0 / 30.0, 31, line);
  double moving_s = 0.0;
  for (int k = 0; k < 2000; ++k) {
    bench.cycle();
    assert_true(speed(bench.out()) >= -1e-12);
    if (bench.starved == 0) moving_s = bench.now_s();
  }
  assert_int_equal(bench.starved, 1);
  assert_int_equal(bench.starved_id, id);
  assert_true(moving_s < 1.0);
  assert_true(bench.out().standing());
  ASSERT_NEAR(bench.way_now(), line(1.0), 1e-9);
  bench.send_targets(bench.now_s(), 1.0 / 30.0, 31, [&](double t) { return line(t - 1.0); });
  bench.run(0.9);
  ASSERT_NEAR(bench.way_now(), line(bench.now_s() - 1.0), 2e-3);
}
void a_plan_that_runs_out_rests_on_its_last_target_and_is_told(void**) {
  starves<JointSpace>();
  starves<TaskSpace>();
}

/// A successor that begins only at the end of the plan, or a little later, keeps it going.
void a_successor_that_waits_keeps_the_plan_going(void**) {
  for (const double gap_s : {-0.05, 0.0, 0.1}) {
    ChunkBench<JointSpace> bench;
    const auto line = [](double t) { return 0.5 * t; };
    bench.chunk.sequence = 0;
    bench.send_targets(0.0, 0.05, 21, line);
    bench.run(0.5);
    bench.send_targets(1.0 + gap_s, 0.05, 21, line);
    bench.run(1.0);
    assert_int_equal(bench.starved, 0);
    ASSERT_NEAR(speed(bench.out()), 0.5, 1e-9);
    ASSERT_NEAR(bench.way_now(), line(bench.now_s()), 1e-9);
  }
}

void a_chunk_that_ends_rests_at_its_last_target(void**) {
  ChunkBench<JointSpace> bench;
  bench.chunk.ends = true;
  bench.send_targets(0.1, 0.05, 21, [](double t) { return 0.1 * t * t * (3.0 - 2.0 * t); });
  bench.run(1.6);
  assert_int_equal(bench.starved, 0);
  assert_true(bench.out().standing());
  ASSERT_NEAR(bench.way_now(), 0.1 * 1.1 * 1.1 * 0.8, 1e-9);
}

/// A short chunk from rest, faster than the limits allow: on its way the reference does not go
/// back, and past the last target only where the end of its curve is steeper than the limits.
/// Returns how far it did, as a share of the way.
template <class Space>
double off_the_way(Dice& dice) {
  static constexpr std::array<double, 3> kPeriods_s = {1e-3, 2e-3, 8e-3};
  ChunkBench<Space> bench(kPeriods_s[static_cast<std::size_t>(dice.below(3))]);
  bench.chunk.ends = dice.chance(0.5);
  if (bench.chunk.ends && dice.chance(0.5)) bench.chunk.smoothing_s = 0.03;
  const int count = 3 + dice.below(28);
  const double spacing_s = dice.uniform(0.01, 0.05), lasts_s = count * spacing_s;
  const double goal =
      (dice.chance(0.5) ? 1.0 : -1.0) * std::min(dice.uniform(0.1, 2.0) * lasts_s, 0.4);
  const bool straight = dice.chance(0.5);
  const auto x = [&](double t) {
    const double s = std::min(t / lasts_s, 1.0);
    return goal * (straight ? s : s * s * (3.0 - 2.0 * s));
  };
  if (bench.send_targets(spacing_s, spacing_s, count, x) == 0) return 0.0;
  double lowest = 0.0, highest = 0.0;
  for (int k = bench.cycles(6.0); k > 0; --k) {
    bench.cycle();
    lowest = std::min(lowest, bench.way_now() / goal);
    highest = std::max(highest, bench.way_now() / goal);
  }
  assert_true(bench.out().standing());
  ASSERT_NEAR(bench.way_now(), goal, 1e-6);
  return std::max(-lowest, highest - 1.0);
}

/// Between its knots a curve leaves their places; the reference that has joined it goes along.
void a_chunk_that_ends_is_followed_between_its_knots(void**) {
  ChunkBench<JointSpace> bench;
  bench.chunk.ends = true;
  bench.send_targets(0.05, 0.05, 21, [](double t) {
    const int i = static_cast<int>(std::lround(t / 0.05));
    return i > 1 && i < 20 && i % 4 < 2 ? 2e-3 : 0.0;
  });
  double lowest = 0.0;
  for (int k = bench.cycles(1.5); k > 0; --k) {
    bench.cycle();
    lowest = std::min(lowest, bench.way_now());
  }
  assert_true(lowest < -1e-4);  // below the places of all knots
  assert_int_equal(static_cast<std::uint32_t>(bench.client.stream().shaped), 0);
  ASSERT_NEAR(bench.way_now(), 0.0, 1e-9);
}

void a_short_chunk_from_rest_is_reached_neither_backwards_nor_from_beyond(void**) {
  Dice dice{11};
  double joints = 0.0, tip = 0.0;
  for (int i = 0; i < 300; ++i) joints = std::max(joints, off_the_way<JointSpace>(dice));
  for (int i = 0; i < 150; ++i) tip = std::max(tip, off_the_way<TaskSpace>(dice));
  print_message("off the way by at most %.4f of it (joints), %.4f (tip)\n", joints, tip);
  assert_true(joints < 0.1 && tip < 0.1);
}

// Proves RG-31.

/// The benchmark's disagreement: an offset of 15 mrad for each chunk and 1 mrad of noise; without
/// and with the loss of 30 % of the chunks.
void disagreement_costs_little_jerk(void**) {
  for (const double loss : {0.0, 0.3}) {
    ChunkBench<JointSpace> bench;
    bench.chunk.smoothing_s = Chunk<JointSpace>().smoothing_s;
    Dice dice{7};
    const auto normal = [&] {
      double sum = -6.0;
      for (int i = 0; i < 12; ++i) sum += dice.uniform(0.0, 1.0);
      return sum;
    };
    double square = 0.0, step = 0.0;
    const int cycles = bench.cycles(30.0);
    for (int k = 0; k < cycles; ++k) {
      if (k >= 150 && (k - 150) % 300 == 0 && !dice.chance(loss)) {
        const double offset = 15e-3 * normal();
        bench.send_targets((k - 150) * 1e-3, 1.0 / 30.0, 30,
                           [&](double t) { return bench.signal(t) + offset + 1e-3 * normal(); });
      }
      const double a = pull(bench.out()), x = bench.way_now();
      bench.cycle();
      square += std::pow((pull(bench.out()) - a) / 1e-3, 2);
      step = std::max(step, std::abs(bench.way_now() - x));
    }
    const double jerk = std::sqrt(square / cycles);
    print_message("loss %.0f %%: rms jerk %.0f rad/s^3, largest step %.2f mrad\n", 100.0 * loss,
                  jerk, 1e3 * step);
    assert_true(jerk < 250.0);
    assert_true(step < 2.2e-3);
  }
}

// Proves RG-32.

/// Relative targets count from where the robot was at the observation, not where it is now.
void relative_targets_count_from_the_observation(void**) {
  for (const ChunkBase base : {ChunkBase::kMeasured, ChunkBase::kCommanded}) {
    ChunkBench<TaskSpace> bench;
    bench.params.feedback_divisor = 10;
    ASSERT_OK(bench.start(bench.home));
    bench.chunk.sequence = 0;
    bench.send_targets(0.0, 0.05, 40, sine);
    const double lag = 0.01;
    TaskSpace::Point observed;
    for (int k = 0; k < 1000; ++k) {
      TaskSpace::Point measured = bench.out();
      measured.x.p[2] -= lag;
      ASSERT_OK(bench.step(measured));
      Feedback<TaskSpace> feedback;
      while (bench.client.poll_feedback(feedback)) {
        if (std::abs(feedback.time_s - 0.7) < 1e-6)
          observed = base == ChunkBase::kMeasured ? feedback.actual : feedback.desired;
      }
    }
    bench.chunk.base = base;
    bench.chunk.observed_s = 0.7;
    bench.chunk.ends = true;
    bench.chunk.count = 0;
    ++bench.chunk.sequence;
    for (int i = 0; i < 20; ++i) {
      TaskSpace::Point target;  // to 50 mm along the axis of the tip
      target.x.p[2] = 0.05 * i / 19.0;
      bench.chunk.add(1.0 + 0.05 * i, target);
    }
    assert_true(bench.send_again() != 0);
    bench.run(1.5);
    const Vector3 goal = observed.x.p + observed.x.r * Vector3(0.0, 0.0, 0.05);
    ASSERT_NEAR((bench.out().x.p - goal).norm(), 0.0, 1e-6);
    bench.chunk.observed_s = -5.0;
    assert_int_equal(bench.send_again(), 0);
    ASSERT_STATUS(bench.verdict.status, Status::kReferenceTime);
    bench.chunk.base = ChunkBase::kAbsolute;
    bench.chunk.ends = false;
  }
}

/// From rest a quintic leads to the first target, if half of every limit is enough, from 50 ms on.
void a_near_first_target_is_met_at_its_stamp(void**) {
  ChunkBench<JointSpace> bench;
  bench.send_targets(0.06, 0.05, 10, [](double) { return 1e-4; });
  bench.run(0.08);
  ASSERT_NEAR(bench.way_now(), 1e-4, 1e-9);
}

// Proves RG-40.

/// Of each chunk the first targets are those of the plan before, and the others are on either side
/// in turn: steps that no arm can follow, and seams in the middle of them.
template <class Space>
void steps_behind_a_prefix(double period_s) {
  constexpr double kSpacing_s = 1.0 / 30.0;
  constexpr int kCount = 20, kSteps = 500;
  Dice dice{17};
  for (const double side : {0.015, 0.06, 0.2}) {
    ChunkBench<Space> bench(period_s);
    std::array<double, kSteps> plan{};
    double farthest = 0.0;
    for (int i = 0, wait = 0; bench.now_s() < 12.0; --wait) {
      bench.cycle();
      farthest = std::max(farthest, std::abs(bench.way_now()));
      if (wait > 0) continue;
      wait = bench.cycles(dice.uniform(0.15, 0.3));
      const int first = static_cast<int>(bench.now_s() / kSpacing_s) + 1;
      const double to = ++i % 2 == 0 ? side : -side;
      std::fill(plan.begin() + first + 8, plan.begin() + first + kCount, to);
      bench.send_targets(first * kSpacing_s, kSpacing_s, kCount, [&](double t) {
        return plan[static_cast<std::size_t>(t / kSpacing_s + 0.5)];
      });
    }
    assert_true(farthest > 0.5 * side);
    if (!(farthest < 1.3 * side + 0.03)) print_error("%g of %g\n", farthest, side);
    assert_true(farthest < 1.3 * side + 0.03);
  }
}
void steps_that_nothing_can_follow_do_not_lead_away(void**) {
  for (const double period_s : {1e-3, 8e-3}) {
    steps_behind_a_prefix<JointSpace>(period_s);
    steps_behind_a_prefix<TaskSpace>(period_s);
  }
}

/// Chunks of four targets, of which the last alone is new, every 50 ms: their plan runs out at
/// once, and the fade of the joint that steps by more takes longer than that of the other would.
void a_small_step_beside_a_large_one_does_not_lead_away(void**) {
  constexpr double kSpacing_s = 1.0 / 30.0, kLarge = 0.124, kSmall = 0.02;
  ChunkBench<JointSpace> bench(1e-3);
  std::array<double, 500> plan{};
  double farthest = 0.0;
  for (int k = 0; k < bench.cycles(10.0); ++k) {
    bench.cycle();
    farthest = std::max(farthest, std::abs(bench.out().q[5] - bench.home.q[5]));
    if (k % 50 != 0) continue;
    const auto first = static_cast<std::size_t>(bench.now_s() / kSpacing_s) + 1;
    plan[first + 3] = k % 100 == 0 ? 1.0 : -1.0;
    bench.chunk.count = 0;
    ++bench.chunk.sequence;
    for (std::size_t i = first; i < first + 4; ++i) {
      JointSpace::Point target = moved_by(bench.home, kLarge * plan[i]);
      target.q[5] += kSmall * plan[i];
      bench.chunk.add(static_cast<double>(i) * kSpacing_s, target);
    }
    bench.send_again();
  }
  assert_true(farthest > 0.5 * kSmall);
  if (!(farthest < 1.3 * kSmall + 0.01)) print_error("%g of %g\n", farthest, kSmall);
  assert_true(farthest < 1.3 * kSmall + 0.01);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(agreeing_chunks_add_no_delay_and_no_standstill),
      cmocka_unit_test(a_plan_that_runs_out_rests_on_its_last_target_and_is_told),
      cmocka_unit_test(a_successor_that_waits_keeps_the_plan_going),
      cmocka_unit_test(a_chunk_that_ends_rests_at_its_last_target),
      cmocka_unit_test(a_chunk_that_ends_is_followed_between_its_knots),
      cmocka_unit_test(a_short_chunk_from_rest_is_reached_neither_backwards_nor_from_beyond),
      cmocka_unit_test(disagreement_costs_little_jerk),
      cmocka_unit_test(relative_targets_count_from_the_observation),
      cmocka_unit_test(a_near_first_target_is_met_at_its_stamp),
      cmocka_unit_test(steps_that_nothing_can_follow_do_not_lead_away),
      cmocka_unit_test(a_small_step_beside_a_large_one_does_not_lead_away),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
