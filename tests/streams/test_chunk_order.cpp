// What becomes of a chunk by its order, its epoch and its stamps.
#include "tests/streams/chunk_bench.hpp"
#include "tests/support/testing.hpp"

namespace {

using namespace tactus;

double sine(double t) {
  return 0.2 * std::sin(2.0 * t);
}

// Proves RG-27.

void a_duplicate_and_an_older_chunk_are_dropped_whole(void**) {
  ChunkBench<JointSpace> bench, other;
  for (ChunkBench<JointSpace>* each : {&bench, &other}) {
    each->chunk.sequence = 6;
    each->send_targets(0.0, 0.05, 30, sine);
    each->run(0.1);
    ASSERT_STATUS(each->last.outcome, Outcome::kExecuted);
  }
  bench.chunk.sequence = 6;
  const std::uint32_t again = bench.send_targets(0.0, 0.05, 30, [](double) { return 0.4; });
  bench.chunk.sequence = 2;
  const std::uint32_t older = bench.send_targets(0.2, 0.05, 30, [](double) { return 0.4; });
  assert_true(again != 0 && older != 0);
  for (int k = 0; k < 500; ++k) {
    bench.cycle();
    other.cycle();
    assert_true(bench.out().q == other.out().q);
  }
  ASSERT_STATUS(bench.last.outcome, Outcome::kSuperseded);
  assert_int_equal(static_cast<std::uint32_t>(bench.client.stream().dropped), 2);
}

void a_chunk_without_a_target_ahead_is_late_and_changes_nothing(void**) {
  ChunkBench<JointSpace> bench, other;
  for (ChunkBench<JointSpace>* each : {&bench, &other}) {
    each->chunk.sequence = 0;
    each->send_targets(0.0, 0.05, 40, sine);
    each->run(1.0);
  }
  bench.send_targets(0.1, 0.05, 10, [](double) { return 0.4; });
  for (int k = 0; k < 500; ++k) {
    bench.cycle();
    other.cycle();
    assert_true(bench.out().q == other.out().q);
  }
  ASSERT_STATUS(bench.last.outcome, Outcome::kRefused);
  ASSERT_STATUS(bench.last.verdict.status, Status::kChunkLate);
  ASSERT_NEAR(bench.last.verdict.value, 1.001 - 0.55, 1e-9);
  assert_int_equal(static_cast<std::uint32_t>(bench.client.stream().late), 1);
}

/// Until its first stamp the plan before it goes on; what has passed of it is trimmed.
void a_chunk_takes_effect_from_its_first_stamp_ahead(void**) {
  for (const double first_s : {1.2, 0.8}) {
    ChunkBench<JointSpace> bench, other;
    for (ChunkBench<JointSpace>* each : {&bench, &other}) {
      each->chunk.sequence = 0;
      each->send_targets(0.0, 0.05, 40, sine);
      each->run(1.0);
    }
    bench.send_targets(first_s, 0.05, 30, [](double t) { return sine(t) + 0.05; });
    const double seam_s = std::max(first_s, bench.now_s());
    for (int k = 0; k < 600; ++k) {
      bench.cycle();
      other.cycle();
      if (bench.now_s() < seam_s - 1e-9) assert_true(bench.out().q == other.out().q);
    }
    ASSERT_NEAR(bench.way_now(), sine(bench.now_s()) + 0.05, 1e-3);
    ASSERT_NEAR(static_cast<double>(static_cast<float>(bench.client.stream().seam)), 0.05, 2e-3);
    const std::uint32_t trimmed = bench.client.stream().trimmed;
    assert_int_equal(trimmed, first_s < 1.0 ? 6 : 1);  // one of the first chunk
  }
}

void a_stop_voids_the_epoch(void**) {
  ChunkBench<JointSpace> bench;
  bench.chunk.epoch = 3;
  bench.chunk.sequence = 0;
  bench.send_targets(0.0, 0.05, 60, sine);
  bench.run(0.5);
  bench.cancel();
  bench.run(0.5);
  assert_true(bench.out().standing());
  const JointVector rest = bench.out().q;
  assert_int_equal(static_cast<std::uint32_t>(bench.client.stream().epoch), 4);
  bench.send_targets(1.0, 0.05, 60, sine);
  bench.run(0.1);
  ASSERT_STATUS(bench.last.verdict.status, Status::kEpochVoid);
  assert_true(bench.out().q == rest);
  bench.chunk.epoch = 4;
  bench.send_targets(1.0, 0.05, 60, sine);
  bench.run(0.5);
  ASSERT_STATUS(bench.last.outcome, Outcome::kExecuted);
  bench.brake(Status::kCollision);
  ASSERT_OK(bench.start(bench.out()));
  bench.run(0.01);
  bench.send_targets(0.0, 0.05, 60, sine);
  bench.run(0.1);
  ASSERT_STATUS(bench.last.verdict.status, Status::kEpochVoid);
  assert_true(bench.out().standing());
}

// Proves RG-26.

void a_chunk_of_one_target_is_a_point(void**) {
  ChunkBench<JointSpace> bench;
  MotionBench<JointSpace> other(1e-3);
  bench.send_targets(0.0, 0.05, 1, [](double) { return 0.3; });
  other.send(moved_by(other.home, 0.3));
  for (int k = 0; k < 1500; ++k) {
    bench.cycle();
    ASSERT_OK(other.step());
    assert_true(bench.out().q == other.out().q);
  }
  ASSERT_NEAR(bench.way_now(), 0.3, 1e-12);
}

/// Whatever the time at which they begin; their rounding is no part of a period.
void stamps_may_be_a_period_apart_and_no_less(void**) {
  Dice dice{5};
  for (int i = 0; i < 300; ++i) {
    ChunkBench<JointSpace> bench(i % 3 == 0 ? 1e-3 : i % 3 == 1 ? 2e-3 : 8e-3);
    const double first_s = dice.uniform(0.0, 100.0);
    assert_true(bench.send_targets(first_s, bench.period_s, 20, [](double) { return 0.0; }) != 0);
    assert_int_equal(
        bench.send_targets(first_s, 0.999 * bench.period_s, 20, [](double) { return 0.0; }), 0);
    ASSERT_STATUS(bench.verdict.status, Status::kReferenceTime);
  }
}

/// A chunk that waits for its first stamp must not bring back what a velocity has ended.
void a_chunk_after_a_velocity_goes_on_from_the_reference(void**) {
  for (const bool ends : {true, false}) {
    ChunkBench<JointSpace> bench;
    const double most = bench.channel.settings.limits.ddq_max[0] * bench.period_s * 1.001;
    bench.chunk.ends = ends;
    bench.send_targets(0.02, 0.02, 3, [](double) { return 0.0; });
    bench.run(0.03);
    Velocity<JointSpace> velocity;
    velocity.rates[0] = 0.3;
    velocity.timeout_s = 2.0;
    std::uint32_t id = 0;
    ASSERT_OK(bench.client.send(velocity, id).status);
    bench.run(0.4);
    const double reached = bench.way_now();
    assert_true(reached > 0.05);
    bench.chunk.ends = true;
    bench.send_targets(bench.now_s() + 0.3, 0.1, 6, [&](double) { return reached + 0.1; });
    JointSpace::Point before = bench.out();
    for (int k = bench.cycles(1.0); k > 0; --k) {
      bench.cycle();
      assert_true(std::abs(bench.out().dq[0] - before.dq[0]) <= most);
      assert_true(bench.way_now() >= reached);
      ASSERT_NEAR(bench.out().q[0], before.q[0] + bench.period_s * before.dq[0], 1e-5);
      before = bench.out();
    }
    ASSERT_NEAR(bench.way_now(), reached + 0.1, 1e-9);
  }
}

void targets_that_no_limit_could_shape_are_refused(void**) {
  ChunkBench<JointSpace> bench;
  assert_int_equal(bench.send_targets(0.0, 1e-3, 2, [](double t) { return 100.0 * t; }), 0);
  ASSERT_STATUS(bench.verdict.status, Status::kVelocityLimit);
  assert_int_equal(bench.verdict.waypoint, 1);
  bench.chunk.velocities = true;
  bench.chunk.count = 0;
  for (const double t : {0.1, 0.2}) bench.chunk.add(t, bench.home);
  bench.chunk.targets[1].dq[2] = 1e200;
  assert_int_equal(bench.send_again(), 0);
  ASSERT_STATUS(bench.verdict.status, Status::kVelocityLimit);
  assert_true(bench.verdict.waypoint == 1 && bench.verdict.axis == 2);
}

/// The server's clock may be asked for a time that never comes.
void a_chunk_of_a_distant_future_is_refused_and_changes_nothing(void**) {
  ChunkBench<JointSpace> bench;
  const typename JointSpace::Point before = bench.out();
  for (const double first_s : {kLongestChunk_s + 1.0, 1e200}) {
    bench.send_targets(first_s, 0.05, 3, [](double) { return 0.3; });
    bench.run(0.1);
    ASSERT_STATUS(bench.last.verdict.status, Status::kReferenceTime);
    assert_true(bench.out().q == before.q && bench.out().standing());
  }
}

void a_bad_chunk_is_refused_with_its_place(void**) {
  ChunkBench<JointSpace> bench;
  const auto refused = [&](double first, double spacing, int count, double x) {
    assert_int_equal(bench.send_targets(first, spacing, count, [&](double) { return x; }), 0);
    return bench.verdict;
  };
  ASSERT_STATUS(refused(0.0, 0.05, 0, 0.0).status, Status::kReferenceSize);
  ASSERT_STATUS(refused(0.0, 1e-4, 3, 0.0).status, Status::kReferenceTime);
  ASSERT_STATUS(refused(std::nan(""), 0.05, 3, 0.0).status, Status::kReferenceNotFinite);
  ASSERT_STATUS(refused(0.0, 0.05, 3, std::nan("")).status, Status::kReferenceNotFinite);
  const Verdict outside = refused(0.0, 0.05, 3, 10.0);
  ASSERT_STATUS(outside.status, Status::kPositionLimit);
  assert_true(outside.waypoint == 0 && outside.axis == 0 && outside.value > outside.limit);
  const Verdict apart = refused(-1e200, 1e200, 3, 0.0);
  ASSERT_STATUS(apart.status, Status::kReferenceTime);
  assert_int_equal(apart.waypoint, 1);
  bench.chunk.fade_s = 0.5;
  ASSERT_STATUS(refused(0.0, 0.05, 3, 0.0).status, Status::kBadValue);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_duplicate_and_an_older_chunk_are_dropped_whole),
      cmocka_unit_test(a_chunk_without_a_target_ahead_is_late_and_changes_nothing),
      cmocka_unit_test(a_chunk_takes_effect_from_its_first_stamp_ahead),
      cmocka_unit_test(stamps_may_be_a_period_apart_and_no_less),
      cmocka_unit_test(a_stop_voids_the_epoch),
      cmocka_unit_test(a_chunk_of_one_target_is_a_point),
      cmocka_unit_test(a_chunk_after_a_velocity_goes_on_from_the_reference),
      cmocka_unit_test(targets_that_no_limit_could_shape_are_refused),
      cmocka_unit_test(a_chunk_of_a_distant_future_is_refused_and_changes_nothing),
      cmocka_unit_test(a_bad_chunk_is_refused_with_its_place),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
