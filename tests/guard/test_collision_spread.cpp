// Tests the collision check as it is spread over cycles: each check judges the state of the cycle
// in which it began, takes the cycles of its section at most, and says what a whole check says.
#include "sim_plant/arm/plant_params.hpp"
#include "tests/guard/collision_bench.hpp"
#include "tests/support/model_cases.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

const JointVector kStill = JointVector::Zero();

/// A bench whose boxes are far away, for checks of so many cycles.
struct Clear : CollisionBench {
  explicit Clear(int cycles) {
    boxes[0].pose.p.z() = boxes[1].pose.p.z() = -5.0;
    section.cycles = cycles;
    start();
  }
  /// Puts a box around the tip.
  void block() { boxes[1].pose.p = tip_pose(ready_pose(), Pose{tip, {1.0, 0.0, 0.0, 0.0}}).p; }
  Status step() { return CollisionBench::step(ready_pose(), kStill); }
};

// Proves COL-6.

/// A check that has to look ahead takes the cycles of its section. One whose credits last until
/// rest ends in its own cycle.
void a_check_ends_after_its_cycles_at_most(void**) {
  RandomStates states;
  int spread = 0, at_once = 0;
  for (const int cycles : {2, 5, 10}) {
    CollisionBench bench;
    bench.section.cycles = cycles;
    bench.start();
    for (int i = 0; i < 300; ++i) {
      states.next();
      const JointVector dq = 0.3 * (i % 4) * states.dq;
      const std::int64_t ended = bench.collision.telemetry().checks;
      Status status = Status::kOk;
      int k = 0;
      for (; status == Status::kOk && bench.collision.telemetry().checks == ended; ++k)
        status = bench.step(states.q, dq);
      assert_int_equal(bench.collision.telemetry().checks, ended + 1);
      assert_in_range(k, 1, cycles);
      spread += status == Status::kOk && k == cycles;
      at_once += status == Status::kOk && k == 1;
    }
  }
  print_message("%d checks were spread, %d ended at once\n", spread, at_once);
  assert_true(spread > 20 && at_once > 20);
}

// Proves COL-1, COL-6.

/// Cycle by cycle, another state is measured than in the first: the check does not look at it.
void spread_over_cycles_a_check_says_what_a_whole_one_says(void**) {
  static CollisionBench bench, whole;
  RandomStates states;
  int contacts = 0, predicted = 0;
  for (const int cycles : {2, 5, 10}) {
    bench.section.cycles = whole.section.cycles = cycles;
    bench.start();
    whole.start();
    for (int i = 0; i < 300; ++i) {
      states.next();
      const JointVector dq = 0.2 * states.dq;
      const Status expected = whole.check(states.q, dq);
      const std::int64_t ended = bench.collision.telemetry().checks;
      Status status = bench.step(states.q, dq);
      while (status == Status::kOk && bench.collision.telemetry().checks == ended) {
        states.next();
        status = bench.step(states.q, states.dq);
      }
      ASSERT_STATUS(status, expected);
      if (status == Status::kOk) continue;
      const Collision::Telemetry &told = bench.collision.telemetry(),
                                 &once = whole.collision.telemetry();
      assert_ptr_equal(told.first, once.first);
      assert_ptr_equal(told.second, once.second);
      assert_true(told.predicted == once.predicted && told.sweep_m == once.sweep_m);
      ++contacts;
      predicted += told.predicted;
    }
  }
  assert_true(contacts > 100 && predicted > 20 && contacts - predicted > 20);
}

void after_a_contact_the_next_check_begins_at_once(void**) {
  Clear bench(5);
  bench.block();
  bench.start();
  for (int i = 1; i <= 3; ++i) {
    ASSERT_STATUS(bench.step(), Status::kCollision);
    assert_int_equal(bench.collision.telemetry().checks, i);
  }
}

void a_start_begins_anew(void**) {
  Clear bench(5);
  for (int i = 0; i < 3; ++i) ASSERT_OK(bench.step());
  bench.block();
  bench.start();
  ASSERT_STATUS(bench.step(), Status::kCollision);
}

// Proves COL-4.

void what_is_not_finite_is_no_pass_in_any_cycle(void**) {
  Clear bench(5);
  JointVector bad = ready_pose();
  bad[1] = std::nan("");
  for (int i = 0; i < 5; ++i) {
    ASSERT_OK(bench.step());
    ASSERT_STATUS(bench.CollisionBench::step(bad, kStill), Status::kStateNotFinite);
    ASSERT_STATUS(bench.CollisionBench::step(ready_pose(), bad), Status::kStateNotFinite);
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_check_ends_after_its_cycles_at_most),
      cmocka_unit_test(spread_over_cycles_a_check_says_what_a_whole_one_says),
      cmocka_unit_test(after_a_contact_the_next_check_begins_at_once),
      cmocka_unit_test(a_start_begins_anew),
      cmocka_unit_test(what_is_not_finite_is_no_pass_in_any_cycle),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
