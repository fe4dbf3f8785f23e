// Tests the detection of a guard that limits for too long, and the rung it leads to.
#include <cstring>
#include <random>
#include <vector>

#include "kernel/cycle/limiting_watch.hpp"
#include "tests/cycle/executive_bench.hpp"
#include "tests/pipeline/pipeline_bench.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

// Proves GRD-9.

void limiting_without_a_pause_is_found_at_the_stated_share_of_the_window(void**) {
  for (const double share : {0.0, 0.25, 0.5, 0.9}) {
    LimitingWatch watch;
    watch.start(share, 1600);
    int found = 0;
    for (int k = 1; found == 0 && k <= 1600; ++k) found = watch.add(true) ? k : 0;
    assert_int_equal(found, static_cast<int>(share * 1600) + 1);
    found = 0;  // counting restarts
    for (int k = 1; found == 0 && k <= 1600; ++k) found = watch.add(true) ? k : 0;
    assert_int_equal(found, static_cast<int>(share * 1600) + 1);
  }
}

void a_share_of_one_is_never_exceeded(void**) {
  LimitingWatch watch;
  watch.start(1.0, 160);
  for (int k = 0; k < 10000; ++k) assert_false(watch.add(true));
}

/// Compares with a sum over the cycles of the last window: every window clearly above the share is
/// reported, and none below it.
void in_between_the_window_decides(void**) {
  std::mt19937 random(20261122);
  for (int trial = 0; trial < 200; ++trial) {
    constexpr int kWindow = 320;
    constexpr double kShare = 0.5;
    LimitingWatch watch;
    watch.start(kShare, kWindow);
    std::vector<int> limited;
    const double often = 0.3 + 0.002 * trial;
    std::bernoulli_distribution draw(often);
    bool found = false;
    int most = 0;
    for (int k = 0; k < 3000 && !found; ++k) {
      limited.push_back(draw(random) ? 1 : 0);
      found = watch.add(limited.back() != 0);
      int sum = 0;
      for (std::size_t i = limited.size() > kWindow ? limited.size() - kWindow : 0;
           i < limited.size(); ++i)
        sum += limited[i];
      most = std::max(most, sum);
      if (found) assert_true(sum > kShare * kWindow);
    }
    if (!found) assert_true(most <= kShare * kWindow + kWindow / LimitingWatch::kParts);
  }
}

/// Torques that change faster than their rate allows, in every cycle.
constexpr const char* kJumping =
    "[robot]\nname = fer\nperiod_us = 1000\ntau_c = pd.tau\n%s"
    "[jrg]\ntype = joint_reference_generator\nq = robot.q\n"
    "[pd]\ntype = pd_gravity\nq_d = jrg.q_d\nq = robot.q\ndq = robot.dq\nkp = 1\nkd = 100\n";

ExecutiveBench& jumping(const char* guard) {
  static char text[512];
  std::snprintf(text, sizeof text, kJumping, guard);
  ExecutiveBench& b = fresh_bench(text);
  ASSERT_OK(b.start());
  return b;
}

void assert_stopped_for_limiting(const Executive& executive) {
  Event event;
  assert_true(executive.events().read(executive.events().count() - 1, event));
  assert_int_equal(static_cast<int>(event.cause), static_cast<int>(Cause::kLimiting));
  ASSERT_STATUS(event.status, Status::kLimiting);
  assert_true(event.from == Rung::kNominal && event.to == Rung::kStop);
}

Status jump(ExecutiveBench& b) {
  b.hal.state.dq[0] = b.hal.state.dq[0] > 0.0 ? -0.3 : 0.3;  // 60 N m in a cycle, 1 is the limit
  return b.cycle();
}

void limiting_in_more_than_half_of_a_second_stops_the_robot(void**) {
  ExecutiveBench& b = jumping("");
  int cycles = 0;
  while (cycles < 2000 && jump(b) == Status::kOk) ++cycles;
  assert_in_range(cycles, 495, 505);
  assert_stopped_for_limiting(b.executive);
  assert_int_equal(static_cast<int>(Status::kLimiting), 83);
}

void share_and_window_are_the_files(void**) {
  ExecutiveBench& b = jumping("[guard]\nlimiting_share = 0.1\nlimiting_window = 0.16\n");
  int cycles = 0;
  while (cycles < 2000 && jump(b) == Status::kOk) ++cycles;
  assert_in_range(cycles, 15, 18);
  ExecutiveBench& off = jumping("[guard]\nlimiting_share = 1\n");
  for (int k = 0; k < 5000; ++k) ASSERT_OK(jump(off));
}

/// The paper's gains times ten: the torque rate is limited in almost every cycle.
void gains_that_are_much_too_high_do_not_succeed(void**) {
  need_one_of({"fer_jrg_pdgc"});
  static PipelineBench bench;
  bench.start("fer_jrg_pdgc", "kp   = 500 400 400 300 20 20 10  # N m/rad\nkd   = 50 40 40 5 2 2 1",
              "kp = 5000 4000 4000 3000 200 200 100\nkd = 500 400 400 50 20 20 10",
              "pipelines/trajectories/fer_five_waypoints.csv");
  Status status = Status::kOk;
  while (status == Status::kOk && bench.time_s() < 10.0)
    status = bench.executive.cycle(bench.next());
  ASSERT_STATUS(status, Status::kLimiting);
  assert_stopped_for_limiting(bench.executive);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(limiting_without_a_pause_is_found_at_the_stated_share_of_the_window),
      cmocka_unit_test(a_share_of_one_is_never_exceeded),
      cmocka_unit_test(in_between_the_window_decides),
      cmocka_unit_test(limiting_in_more_than_half_of_a_second_stops_the_robot),
      cmocka_unit_test(share_and_window_are_the_files),
      cmocka_unit_test(gains_that_are_much_too_high_do_not_succeed),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
