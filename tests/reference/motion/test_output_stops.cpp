// Digital outputs of chunks and points stay as they are at every stop; points set them at once.
#include "tests/reference/motion/output_bench.hpp"
#include "tests/support/testing.hpp"

namespace {

using namespace tactus;

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
  assert_true(bench.generator.phase() == Phase::kHolding);
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

int main() {
  const CMUnitTest tests[] = {
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
