// Tests the cycle's end of the mailboxes between cycle and server.
#include "program/cycle_endpoint.hpp"

#include <cmath>
#include <optional>

#include "kernel/load/loader.hpp"
#include "program/session/host_sections.hpp"
#include "sim_plant/arm/sim_hal.hpp"
#include "tests/support/fresh.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

/// An executive of a pipeline without blocks, with a simulated arm, at its endpoint.
struct Bench {
  SimHal hal;
  RoomyPipeline pipeline;
  ChannelMemory<JointSpace> channel;
  CycleMailboxes mailboxes;
  Executive executive{hal, pipeline};
  std::optional<CycleEndpoint> endpoint;
  std::int64_t now_ns = 0;
  std::uint32_t next = 1;

  static constexpr const char* kText = "[robot]\nname = fer\nperiod_us = 1000\ntau_c = robot.tau\n";

  void load(std::string_view text) {
    LoadError error;
    HostSections sections;
    Loader loader({&channel, nullptr}, hal.capabilities(), sections);
    ASSERT_OK(loader.load(text, pipeline, error));
    hal.set_period(1e-3);
    ASSERT_OK(hal.load(PlantParams(), 1));
    executive.in_virtual_time();
    endpoint.emplace(mailboxes, executive, pipeline);
    ASSERT_OK(executive.start());
    static_cast<void>(executive.arm());
  }
  void start() {
    load(kText);
    for (int i = 0; i < 1000 && executive.rung() != Rung::kNominal; ++i) cycle();
    assert_true(executive.rung() == Rung::kNominal);
  }
  void cycle() {
    now_ns += 1'000'000;
    endpoint->work(executive.cycle({now_ns}));
    endpoint->publish({now_ns});
  }
  bool post(CycleOrder order) { return mailboxes.orders.post({next++, order}); }
};

// Proves GW-10.

void a_cycle_takes_one_order_however_many_wait(void**) {
  Bench& bench = fresh<Bench>();
  int posted = 0;
  while (bench.post(CycleOrder::kStop)) ++posted;
  assert_int_equal(posted, 8);
  for (int left = posted; left > 0; --left) {
    assert_int_equal(bench.mailboxes.orders.size(), left);
    bench.cycle();
  }
  bench.cycle();
  assert_int_equal(bench.mailboxes.orders.size(), 0);
  assert_int_equal(bench.mailboxes.results.size(), posted);
}

void a_cycle_posts_one_snapshot_and_counts_those_without_space(void**) {
  Bench& bench = fresh<Bench>();
  CycleSnapshot told;
  while (bench.mailboxes.snapshots.take(told)) {
  }
  for (std::size_t i = 1; i <= 32; ++i) {
    bench.cycle();
    assert_int_equal(bench.mailboxes.snapshots.size(), i);
  }
  const std::uint32_t before = told.lost;
  for (int i = 0; i < 10; ++i) bench.cycle();
  assert_int_equal(bench.mailboxes.snapshots.size(), 32);
  while (bench.mailboxes.snapshots.take(told)) {
  }
  bench.cycle();
  assert_true(bench.mailboxes.snapshots.take(told));
  assert_true(told.lost >= before + 10);
  assert_int_equal(told.stamp_ns, bench.now_ns);
}

/// An arm in contact is not armed.
void a_collision_is_told_with_what_it_is(void**) {
  Bench bench;
  bench.load(Message(Bench::kText) << "[wall]\ntype = box\ncentre = 0.3 0 0.5\nsize = 0.2 2 1\n"
                                   << "[collision]\n");
  CycleSnapshot told;
  for (int i = 0; i < 1000 && told.status != Status::kCollision; ++i) {
    bench.cycle();
    while (bench.mailboxes.snapshots.take(told)) {
    }
  }
  ASSERT_STATUS(told.status, Status::kCollision);
  assert_non_null(told.first);
  assert_string_equal(told.first, "wall");
  assert_string_equal(told.second, "link6");
}

/// A law without the gravity of the arm.
void a_joint_that_does_not_stay_at_its_reference_is_told_with_value_and_limit(void**) {
  Bench bench;
  bench.load(
      "[robot]\nname = fer\nperiod_us = 1000\ntau_c = pd.tau\n"
      "[jrg]\ntype = joint_reference_generator\nq = robot.q\npath_tolerance = 0.05\n"
      "goal_time_s = 0.3\n"
      "[pd]\ntype = pid\nq_d = jrg.q_d\nq = robot.q\ndq = robot.dq\nkp = 200\nki = 0\nkd = 20\n");
  CycleSnapshot told;
  for (int i = 0; i < 1000 && told.status != Status::kPathTolerance; ++i) {
    bench.cycle();
    while (bench.mailboxes.snapshots.take(told)) {
    }
  }
  const Verdict& fault = told.fault.verdict;
  ASSERT_STATUS(fault.status, Status::kPathTolerance);
  assert_true(fault.axis >= 0 && fault.value > fault.limit && fault.limit == 0.05);
  ASSERT_NEAR(fault.value, std::abs(told.q_d[fault.axis] - told.q[fault.axis]), 1e-12);
  assert_true(told.fault.axes == VerdictAxes::kJoints);
}

void orders_wait_while_nobody_takes_their_results(void**) {
  Bench& bench = fresh<Bench>();
  for (int i = 0; i < 40; ++i) {
    bench.post(CycleOrder::kStop);
    bench.cycle();
  }
  assert_true(bench.mailboxes.results.size() <= 16);
  assert_int_equal(bench.mailboxes.orders.size(), 8);
  OrderResult result;
  std::uint32_t last = 0;
  for (int i = 0; i < 60; ++i) {
    while (bench.mailboxes.results.take(result)) {
      assert_int_equal(result.id, last + 1);  // every order once, in order
      last = result.id;
    }
    bench.cycle();
  }
  assert_int_equal(bench.mailboxes.orders.size(), 0);
}

void a_stop_disables_the_arm_and_a_rearm_takes_it_over_again(void**) {
  Bench& bench = fresh<Bench>();
  OrderResult result;
  bench.post(CycleOrder::kStop);
  for (int i = 0; i < 3000 && bench.executive.rung() != Rung::kDisabled; ++i) bench.cycle();
  assert_true(bench.executive.rung() == Rung::kDisabled);
  assert_true(bench.mailboxes.results.take(result));
  ASSERT_OK(result.verdict.status);
  for (int i = 0; i < 3000 && bench.executive.busy(); ++i) bench.cycle();
  bench.post(CycleOrder::kRearm);
  for (int i = 0; i < 3000 && bench.mailboxes.results.size() == 0; ++i) bench.cycle();
  assert_true(bench.mailboxes.results.take(result));
  ASSERT_OK(result.verdict.status);
  assert_int_equal(result.id, bench.next - 1);
  assert_true(bench.executive.rung() == Rung::kNominal);
}

// Proves GW-21.

/// Nobody takes the results, so that each is seen.
void a_tare_has_one_result_when_it_ends_and_that_of_a_stopped_arm_at_once(void**) {
  Bench bench;
  bench.load(Message(Bench::kText)
             << "[model]\ntype = robot_model\nq = robot.q\ndq = robot.dq\n"
             << "[sensor]\ntype = wrench_front_end\nft = robot.ft\nx = model.x\n"
             << "tool = robot.tool\nmax_force = 300\nmax_moment = 30\ntare_s = 0.05\n");
  for (int i = 0; i < 1000 && bench.executive.rung() != Rung::kNominal; ++i) bench.cycle();
  for (int i = 0; i < 100; ++i) bench.cycle();
  bench.post(CycleOrder::kTare);
  for (int i = 0; i < 50; ++i) bench.cycle();
  assert_int_equal(bench.mailboxes.results.size(), 0);
  for (int i = 0; i < 100; ++i) bench.cycle();
  assert_int_equal(bench.mailboxes.results.size(), 1);
  OrderResult result;
  assert_true(bench.mailboxes.results.take(result));
  assert_int_equal(result.id, 1);
  ASSERT_OK(result.verdict.status);
  bench.post(CycleOrder::kStop);
  for (int i = 0; i < 3000 && bench.executive.rung() != Rung::kDisabled; ++i) bench.cycle();
  assert_true(bench.mailboxes.results.take(result));
  bench.post(CycleOrder::kTare);
  bench.cycle();
  assert_true(bench.mailboxes.results.take(result));
  assert_int_equal(result.id, 3);
  ASSERT_STATUS(result.verdict.status, Status::kHalted);
}

// Proves PAGE-7.

void the_values_of_all_outputs_are_posted_now_and_then_and_never_waited_for(void**) {
  Bench& bench = fresh<Bench>();
  static PortMailbox ports;
  ports.divisor = 20;
  bench.endpoint->attach(ports);
  PortValues told;
  std::uint32_t last = 0;
  for (int i = 0; i < 200; ++i) {
    bench.cycle();
    if (!ports.values.take(told)) continue;
    assert_true(last == 0 || told.cycle == last + 20);
    last = told.cycle;
    const double* from = told.numbers.data();  // q, dq and tau are the robot's first outputs
    for (int k = 0; k < kDof; ++k) {
      ASSERT_NEAR(from[k], bench.pipeline.robot.q.value[k], 0.0);
      ASSERT_NEAR(from[2 * kDof + k], bench.pipeline.robot.tau.value[k], 0.0);
    }
    assert_int_equal(ports.values.size(), 0);
  }
  assert_true(last > 0);
  for (int i = 0; i < 200; ++i) bench.cycle();  // nobody takes them
  assert_int_equal(ports.values.size(), 2);
  assert_true(ports.values.take(told));
  assert_true(told.cycle <= last + 20);
}

// Proves PAR-8.

/// Sets are taken on every rung but while the arm is braked or armed; each has its verdict in the
/// same cycle.
void a_set_is_taken_unless_the_arm_is_braked_or_armed(void**) {
  Bench& bench = fresh<Bench>();
  Tuning nothing;
  bool seen[kNames<Rung>.size()] = {};
  const auto verdict_now = [&] {
    assert_true(bench.mailboxes.tunings.post({&nothing}));
    bench.cycle();
    TuningVerdict verdict;
    assert_true(bench.mailboxes.tuned.take(verdict));
    seen[static_cast<std::size_t>(bench.executive.rung())] = true;
    return verdict.status;
  };
  ASSERT_OK(verdict_now());
  bench.post(CycleOrder::kStop);
  bench.cycle();
  while (bench.executive.busy() || bench.executive.rung() == Rung::kStop) {
    const bool braked = bench.executive.busy();
    const Status status = verdict_now();
    if (braked && bench.executive.busy()) assert_true(status == Status::kNotAtRest);
  }
  assert_true(bench.executive.rung() == Rung::kDisabled);
  ASSERT_OK(verdict_now());
  bench.post(CycleOrder::kRearm);
  for (int i = 0; i < 1000 && bench.executive.rung() != Rung::kArming; ++i) bench.cycle();
  for (int i = 0; i < 1000 && bench.executive.rung() == Rung::kArming; ++i) {
    const Status status = verdict_now();
    if (bench.executive.rung() == Rung::kArming) assert_true(status == Status::kArming);
  }
  assert_true(bench.executive.rung() == Rung::kNominal);
  ASSERT_OK(verdict_now());
  assert_true(seen[static_cast<std::size_t>(Rung::kArming)]);
  assert_true(seen[static_cast<std::size_t>(Rung::kStop)]);
}

void a_cycle_takes_one_set_and_none_without_space_for_its_verdict(void**) {
  Bench& bench = fresh<Bench>();
  Tuning nothing;
  for (int i = 0; i < 6; ++i) {
    bench.mailboxes.tunings.post({&nothing});
    bench.cycle();
  }
  assert_int_equal(bench.mailboxes.tuned.size(), 2);
  assert_int_equal(bench.mailboxes.tunings.size(), 2);
  TuningVerdict verdict;
  assert_true(bench.mailboxes.tuned.take(verdict));
  bench.cycle();
  assert_int_equal(bench.mailboxes.tuned.size(), 2);
  assert_int_equal(bench.mailboxes.tunings.size(), 1);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_cycle_takes_one_order_however_many_wait),
      cmocka_unit_test(a_cycle_posts_one_snapshot_and_counts_those_without_space),
      cmocka_unit_test(a_collision_is_told_with_what_it_is),
      cmocka_unit_test(a_joint_that_does_not_stay_at_its_reference_is_told_with_value_and_limit),
      cmocka_unit_test(orders_wait_while_nobody_takes_their_results),
      cmocka_unit_test(a_stop_disables_the_arm_and_a_rearm_takes_it_over_again),
      cmocka_unit_test(a_tare_has_one_result_when_it_ends_and_that_of_a_stopped_arm_at_once),
      cmocka_unit_test(the_values_of_all_outputs_are_posted_now_and_then_and_never_waited_for),
      cmocka_unit_test(a_set_is_taken_unless_the_arm_is_braked_or_armed),
      cmocka_unit_test(a_cycle_takes_one_set_and_none_without_space_for_its_verdict),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
