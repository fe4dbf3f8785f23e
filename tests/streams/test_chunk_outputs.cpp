// Digital outputs beside the targets of chunks: in time with the motion, newest chunk first.
// Digital outputs of chunks and points stay as they are at every stop; points set them at once.
#include "tests/streams/chunk_bench.hpp"
#include "tests/streams/output_edges.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

/// A motion that tells its time.
double line(double t) {
  return 0.3 * t * t / (0.5 + t);
}

/// Gives the chunk that is sent next random outputs.
template <class Space>
void set_outputs(ChunkBench<Space>& bench, Dice& dice, std::uint32_t mask, double lead_s) {
  bench.chunk.outputs_mask = mask;
  bench.chunk.outputs_lead_s = lead_s;
  for (std::uint32_t& outputs : bench.chunk.outputs)
    outputs = static_cast<std::uint32_t>(dice.bits());
}

template <class Space>
void write_targets(ChunkBench<Space>& bench, double first_s, double spacing_s, int count,
                   double shift) {
  bench.chunk.count = count;
  ++bench.chunk.sequence;
  for (int i = 0; i < count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    bench.chunk.time_s[k] = first_s + i * spacing_s;
    bench.chunk.targets[k] =
        moved_by(bench.home, 0.1 * bench.signal(first_s + i * spacing_s) + shift);
  }
}

constexpr std::array<double, 5> kLeads_s = {0.0, 0.05, -0.05, kLongestLead_s, -kLongestLead_s};
constexpr std::array<double, 3> kPeriods_s = {1e-3, 2e-3, 8e-3};

template <class Space>
bool same(const ChunkBench<Space>& bench, const OutputEdges& edges) {
  const DigitalOutputs now = bench.generator.outputs();
  return now.mask == edges.mask() && (now.value & now.mask) == edges.value();
}

// Proves OUT-1, OUT-2.

/// Overlapping chunks that disagree in motion and outputs, late, lost, repeated and out of order.
template <class Space>
void newest_chunk_wins(Dice& dice, int run) {
  static OutputEdges edges;
  const double period_s = kPeriods_s[static_cast<std::size_t>(dice.below(3))];
  const double lead_s = dice.chance(0.5) ? kLeads_s[static_cast<std::size_t>(dice.below(5))]
                                         : dice.uniform(-kLongestLead_s, kLongestLead_s);
  const double spacing_s = dice.uniform(0.02, 0.1);
  const std::uint32_t mask = static_cast<std::uint32_t>(dice.bits()) | 1u;
  ChunkBench<Space> bench(period_s);
  edges.start(mask, lead_s, period_s);
  const int every = bench.cycles(dice.uniform(0.05, 0.3));
  for (int k = 0; k < bench.cycles(4.0); ++k) {
    const double now_s = bench.now_s();
    const bool sends = k % every == 0 && !dice.chance(0.2);
    if (sends) {
      set_outputs(bench, dice, mask, lead_s);
      write_targets(bench, now_s - dice.uniform(-0.1, 0.4), spacing_s, 60,
                    dice.uniform(-0.01, 0.01));
      const std::uint32_t newest = bench.chunk.sequence;
      if (dice.chance(0.1)) bench.chunk.sequence -= std::min(newest - 1, 2u);
      const std::uint32_t id = bench.send_again();
      bench.chunk.sequence = newest;
      assert_true(id != 0);
      bench.cycle();
      edges.move_on(bench.now_s());
      if (bench.last.id == id && bench.last.outcome == Outcome::kExecuted)
        edges.take(
            bench.now_s(), bench.chunk.count,
            [&](int i) { return bench.chunk.time_s[static_cast<std::size_t>(i)]; },
            [&](int i) { return bench.chunk.outputs[static_cast<std::size_t>(i)]; });
    } else {
      bench.cycle();
      edges.move_on(bench.now_s());
    }
    const bool right = same(bench, edges);
    if (!right)
      print_error(
          "run %d, %g ms, lead %g s, spacing %g s, at %g s: 0x%x of 0x%x instead of 0x%x of 0x%x\n",
          run, 1e3 * period_s, lead_s, spacing_s, bench.now_s(), bench.generator.outputs().value,
          bench.generator.outputs().mask, edges.value(), edges.mask());
    assert_true(right);
  }
  assert_int_equal(bench.starved, 0);
}
void the_newest_chunk_has_the_outputs(void**) {
  for (int run = 0; run < 60; ++run) {
    Dice dice{static_cast<std::uint64_t>(run + 1) * 977};
    newest_chunk_wins<JointSpace>(dice, run);
    newest_chunk_wins<TaskSpace>(dice, run);
  }
}

/// Two chunks, of which the second, sent while the first runs, begins `gap_s` after its end and
/// gives another output. Returns by how many cycles the edge at the end of the first is late.
template <class Space>
int edge_before_a_gap(double period_s, double gap_s, bool replaces) {
  constexpr double kEnd_s = 0.451;
  ChunkBench<Space> bench(period_s);
  const auto write = [&](double first_s, std::uint32_t mask, int on) {
    write_targets(bench, first_s, 0.05, 10, 0.0);
    bench.chunk.outputs_mask = mask;
    for (int i = 0; i < 10; ++i) bench.chunk.outputs[static_cast<std::size_t>(i)] = i == on;
    assert_true(bench.send_again() != 0);
  };
  write(kEnd_s - 0.45, 1, 9);
  bench.run(0.3);
  if (replaces) write(kEnd_s + gap_s + 0.02, 2, -1);
  if (replaces) bench.run(0.05);
  write(kEnd_s + gap_s, 2, -1);
  while (bench.now_s() < kEnd_s + gap_s + 0.3) {
    bench.cycle();
    if ((bench.generator.outputs().value & 1) != 0) break;
  }
  return static_cast<int>(std::floor((bench.now_s() - kEnd_s) / period_s));
}
void the_last_target_before_a_gap_is_passed(void**) {
  for (const double period_s : kPeriods_s)
    for (const double gap_s : {0.0003, 0.005, 0.05, 0.055, 0.2})
      for (const bool replaces : {false, true}) {
        assert_in_range(edge_before_a_gap<JointSpace>(period_s, gap_s, replaces), 0, 1);
        assert_in_range(edge_before_a_gap<TaskSpace>(period_s, gap_s, replaces), 0, 1);
      }
}

// Proves OUT-3.

/// A line on which the position tells the path time. Without a successor edges keep time with the
/// motion that comes to rest, and those after the last target never come. Returns the cycles
/// between an edge and its target at worst.
template <class Space>
int edges_of_a_line(double period_s, double lead_s) {
  ChunkBench<Space> bench(period_s);
  constexpr int kTargets = 31;
  constexpr double kSpacing_s = 1.0 / 30.0;
  bench.chunk.fade_s = 0.0;
  bench.chunk.outputs_mask = 1;
  bench.chunk.outputs_lead_s = lead_s;
  bench.chunk.count = 0;
  ++bench.chunk.sequence;
  for (int i = 0; i < kTargets; ++i) {
    const double t = i * kSpacing_s;
    bench.chunk.add(t, moved_by(bench.home, line(t)), i % 2 == 0 ? 0 : 1);
  }
  assert_true(bench.send_again() != 0);
  int edges = 0, worst = 0, passed = 0, cycle = 0;
  std::uint32_t before = 0;
  std::array<int, kTargets> passed_in{};
  for (; cycle < bench.cycles(3.0); ++cycle) {
    bench.cycle();
    while (passed < kTargets && bench.way_now() >= line(passed * kSpacing_s) - 1e-7)
      passed_in[static_cast<std::size_t>(passed++)] = cycle;
    const DigitalOutputs now = bench.generator.outputs();
    if (now.mask == 0 || now.value == before) continue;
    before = now.value;
    ++edges;
    const int delay = static_cast<int>(std::lround(std::max(-lead_s, 0.0) / period_s));
    assert_true(edges < passed + 1);
    const int off = cycle - passed_in[static_cast<std::size_t>(edges)] - delay;
    worst = std::max(worst, std::abs(off));
  }
  assert_int_equal(edges, kTargets - 1);
  assert_int_equal(bench.starved, 1);
  return worst;
}
void edges_keep_time_with_a_motion_that_starves(void**) {
  for (const double period_s : kPeriods_s)
    for (const double lead_s : {0.0, -0.2}) {
      const int joint = edges_of_a_line<JointSpace>(period_s, lead_s);
      const int tip = edges_of_a_line<TaskSpace>(period_s, lead_s);
      print_message("%g ms, lead %g s: edges %d and %d cycles from the executed stamps\n",
                    1e3 * period_s, lead_s, joint, tip);
      assert_true(joint <= 1 && tip <= 1);
    }
}

/// In a stop at starvation, the time of the motion is behind that of the clock: edges wait for it.
void a_starved_motion_delays_its_edges(void**) {
  ChunkBench<JointSpace> bench;
  bench.chunk.outputs_mask = 1;
  bench.chunk.count = 0;
  ++bench.chunk.sequence;
  for (int i = 0; i <= 30; ++i)
    bench.chunk.add(i / 30.0, moved_by(bench.home, line(i / 30.0)), i == 30 ? 1 : 0);
  assert_true(bench.send_again() != 0);
  while (bench.generator.outputs().value == 0 && bench.now_s() < 3.0) bench.cycle();
  assert_true(bench.now_s() > 1.01);
  assert_true(std::abs(bench.way_now() - line(1.0)) < 1e-5);
}

// Proves OUT-4.

enum class Ending : std::uint8_t { kCancel, kBrake, kAtOnce, kPoint, kVelocity, kPlainChunk };

/// Whatever ends a chunk voids its edges ahead, and leaves outputs as they are.
template <class Space>
void stop_holds(Ending ending) {
  ChunkBench<Space> bench(2e-3);
  Dice dice{17};
  set_outputs(bench, dice, 7, 0.1);
  write_targets(bench, 0.0, 0.05, 60, 0.0);
  assert_true(bench.send_again() != 0);
  bench.run(1.0);
  const DigitalOutputs held = bench.generator.outputs();
  assert_int_equal(held.mask, 7);
  std::uint32_t id = 0;
  bool brakes = false;
  switch (ending) {
    case Ending::kCancel: assert_true(bench.client.cancel(id).ok()); break;
    case Ending::kBrake:
    case Ending::kAtOnce: brakes = true; break;
    case Ending::kPoint: assert_true(bench.client.send(bench.out().at_rest(), id).ok()); break;
    case Ending::kVelocity: {
      Velocity<Space> velocity;
      velocity.timeout_s = 0.1;
      velocity.rates.setZero();
      assert_true(bench.client.send(velocity, id).ok());
      break;
    }
    case Ending::kPlainChunk:
      bench.chunk.outputs_mask = 0;
      write_targets(bench, bench.now_s() - 0.1, 0.05, 60, 0.0);
      assert_true(bench.send_again() != 0);
  }
  for (int k = 0; k < bench.cycles(2.0); ++k) {
    bench.cycle();
    if (brakes)
      bench.brake(Status::kCollision,
                  ending == Ending::kAtOnce ? BrakeWay::kAtOnce : BrakeWay::kOnPath);
    if (k == 0) continue;  // the cycle in which it ends
    assert_true(bench.generator.outputs() == held);
  }
}
void whatever_ends_a_chunk_leaves_outputs_as_they_are(void**) {
  for (const Ending ending : {Ending::kCancel, Ending::kBrake, Ending::kAtOnce, Ending::kPoint,
                              Ending::kVelocity, Ending::kPlainChunk}) {
    stop_holds<JointSpace>(ending);
    stop_holds<TaskSpace>(ending);
  }
}

/// A stop voids an edge whose target was passed but that is delayed.
void a_stop_voids_delayed_edges(void**) {
  ChunkBench<JointSpace> bench;
  bench.chunk.outputs_mask = 1;
  bench.chunk.outputs_lead_s = -0.3;
  bench.chunk.count = 0;
  ++bench.chunk.sequence;
  for (int i = 0; i <= 30; ++i)
    bench.chunk.add(i / 30.0, moved_by(bench.home, line(i / 30.0)), i >= 6 ? 1 : 0);
  assert_true(bench.send_again() != 0);
  bench.run(0.35);
  assert_int_equal(bench.generator.outputs().mask, 1);
  std::uint32_t id = 0;
  assert_true(bench.client.cancel(id).ok());
  bench.run(1.0);
  assert_int_equal(bench.generator.outputs().value, 0);
}

/// They are all that is left to cancel when the motion has ended.
void a_cancel_of_delayed_edges_alone_is_executed(void**) {
  ChunkBench<JointSpace> bench;
  bench.chunk.outputs_mask = 1;
  bench.chunk.outputs_lead_s = -0.5;
  bench.chunk.ends = true;
  bench.chunk.count = 0;
  ++bench.chunk.sequence;
  for (int i = 0; i <= 6; ++i) bench.chunk.add(i / 30.0, bench.home, i == 6 ? 1 : 0);
  assert_true(bench.send_again() != 0);
  bench.run(0.5);
  assert_true(bench.generator.phase() == MotionPhase::kHolding);
  std::uint32_t id = 0;
  assert_true(bench.client.cancel(id).ok());
  bench.run(1.0);
  assert_true(bench.last.id == id && bench.last.outcome == Outcome::kExecuted);
  assert_int_equal(bench.generator.outputs().value, 0);
  assert_true(bench.client.cancel(id).ok());
  bench.cycle();
  assert_true(bench.last.id == id && bench.last.outcome == Outcome::kRefused);
}

/// A start commands none: an output that people have changed does not change back.
void a_start_leaves_outputs_alone(void**) {
  ChunkBench<JointSpace> bench;
  std::uint32_t id = 0;
  assert_true(bench.client.send(bench.home, id, {}, {{3, 7}}).ok());
  bench.cycle();
  assert_true((bench.generator.outputs() == DigitalOutputs{3, 7}));
  ASSERT_OK(bench.start(bench.home));
  bench.cycle();
  assert_true(bench.generator.outputs() == DigitalOutputs());
}

// Proves OUT-5.

void a_point_sets_outputs_at_once(void**) {
  ChunkBench<TaskSpace> bench;
  std::uint32_t id = 0;
  assert_true(bench.client.send(bench.home, id, {}, {{1, 3}}).ok());
  bench.cycle();
  assert_true((bench.generator.outputs() == DigitalOutputs{1, 3}));
  assert_true(bench.client.send(bench.home, id, {}, {{6, 6}}).ok());
  bench.cycle();
  assert_true((bench.generator.outputs() == DigitalOutputs{7, 7}));
  assert_true(bench.client.send(bench.home, id).ok());
  bench.cycle();
  assert_true((bench.generator.outputs() == DigitalOutputs{7, 7}));
  bench.chunk.count = 0;  // a chunk of one target is a point
  ++bench.chunk.sequence;
  bench.chunk.outputs_mask = 2;
  bench.chunk.add(bench.now_s() + 0.5, bench.home, 0);
  assert_true(bench.send_again() != 0);
  bench.cycle();
  assert_true((bench.generator.outputs() == DigitalOutputs{5, 7}));
}

/// A point that is refused, and a chunk that is late, change nothing.
void what_is_refused_sets_no_outputs(void**) {
  ChunkBench<JointSpace> bench;
  bench.run(1.0);
  bench.chunk.outputs_mask = 1;
  bench.chunk.count = 0;
  ++bench.chunk.sequence;
  for (int i = 0; i < 5; ++i) bench.chunk.add(0.1 * i, bench.home, 1);
  assert_true(bench.send_again() != 0);
  bench.run(0.5);
  ASSERT_STATUS(bench.last.verdict.status, Status::kChunkLate);
  assert_int_equal(bench.generator.outputs().mask, 0);
  for (const double lead_s : {-0.51, 0.51, std::nan("")}) {
    bench.chunk.outputs_lead_s = lead_s;
    assert_int_equal(bench.send_again(), 0);
    ASSERT_STATUS(bench.verdict.status, Status::kBadValue);
  }
}

/// More changes within the delay than can wait: pulses are lost, the last state is not.
void more_changes_than_can_wait_end_in_the_last_state(void**) {
  for (const int changes : {32, 33, 100, 127}) {
    ChunkBench<JointSpace> bench;
    bench.chunk.outputs_mask = 1;
    bench.chunk.outputs_lead_s = -kLongestLead_s;
    bench.chunk.ends = true;
    bench.chunk.count = 0;
    ++bench.chunk.sequence;
    for (int i = 0; i <= changes; ++i)
      bench.chunk.add(0.002 * (i + 1), bench.home, static_cast<std::uint32_t>(i % 2));
    assert_true(bench.send_again() != 0);
    bench.run(1.0);
    assert_int_equal(bench.generator.outputs().mask, 1);
    assert_int_equal(bench.generator.outputs().value, changes % 2);
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_newest_chunk_has_the_outputs),
      cmocka_unit_test(the_last_target_before_a_gap_is_passed),
      cmocka_unit_test(edges_keep_time_with_a_motion_that_starves),
      cmocka_unit_test(a_starved_motion_delays_its_edges),
      cmocka_unit_test(whatever_ends_a_chunk_leaves_outputs_as_they_are),
      cmocka_unit_test(a_stop_voids_delayed_edges),
      cmocka_unit_test(a_cancel_of_delayed_edges_alone_is_executed),
      cmocka_unit_test(a_start_leaves_outputs_alone),
      cmocka_unit_test(a_point_sets_outputs_at_once),
      cmocka_unit_test(what_is_refused_sets_no_outputs),
      cmocka_unit_test(more_changes_than_can_wait_end_in_the_last_state),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
