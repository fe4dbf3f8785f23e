// Tests trajectories on their way from a client through the window.
#include "tests/gateway/server/trajectory_parts.hpp"
#include "tests/support/testing.hpp"
#include "tests/support/trials.hpp"

namespace tactus {
namespace {

// Proves GW-6.

void ten_minutes_at_one_kilohertz_pass_through_a_window_of_512_without_a_gap(void**) {
  constexpr int kWhole_s = tries(600, 60), kWaypoints = 1000 * kWhole_s + 1;
  const auto at = [](double t) {
    JointSpace::Point point = swing(std::fmod(t, 3.0), 3.0);
    return t >= kWhole_s ? point.at_rest() : point;
  };
  TwoClients& two = fresh_clients();
  two.a.lease();
  const std::uint32_t goal = two.a.send(ask::kBegin, begin(512));
  two.run(1);
  int sent = 0, began = -1;
  double worst = 0.0;
  for (int cycle = 0; two.a.finals[goal] == 0 && cycle < kWaypoints + 5000; ++cycle) {
    while (sent < kWaypoints && two.a.credit >= std::min(60, kWaypoints - sent)) {
      const int count = std::min(60, kWaypoints - sent);
      two.a.send(ask::kPart, part(sent, sent + count, at));
      two.a.credit -= count;
      sent += count;
      if (sent == kWaypoints) two.a.send(ask::kEnd);
    }
    if (cycle % 500 == 0) two.b.send(ask::kPing);
    two.run(1);
    const bool follows = two.bench.generator.phase() == MotionPhase::kFollowing;
    if (began < 0 && follows) began = cycle;
    if (!follows) continue;
    const double t = 1e-3 * (cycle - began);
    const double error = std::abs(two.bench.generator.reference().q[0] - at(t + 1e-3).q[0]);
    worst = std::max(worst,
                     std::min(error, std::abs(two.bench.generator.reference().q[0] - at(t).q[0])));
  }
  assert_int_equal(sent, kWaypoints);
  assert_int_equal(two.a.starved, 0);
  assert_int_equal(two.a.outcome[goal], 10);  // SUCCEEDED
  assert_true(began >= 0);
  ASSERT_NEAR(worst, 0.0, 1e-6);
}

void the_smallest_window_is_passed_to_its_end(void**) {
  constexpr int kWaypoints = 1001;
  TwoClients& two = fresh_clients();
  two.a.lease(0, 60000);
  const std::uint32_t goal = two.a.send(ask::kBegin, begin(1));
  two.run(1);
  const auto at = [](double t) { return swing(t, 1.0); };
  for (int sent = 0, cycle = 0; two.a.finals[goal] == 0 && cycle < 200'000; ++cycle) {
    if (sent < kWaypoints && two.a.credit > 0) {
      two.a.send(ask::kPart, part(sent, sent + 1, at));
      --two.a.credit;
      if (++sent == kWaypoints) two.a.send(ask::kEnd);
    }
    if (cycle % 500 == 0) two.b.send(ask::kPing);
    two.run(1);
  }
  assert_int_equal(two.a.outcome[goal], 10);  // SUCCEEDED
}

void a_trajectory_that_still_comes_ends_with_its_lease_and_its_epoch(void**) {
  TwoClients& two = fresh_clients();
  two.a.lease();
  two.run(1);
  const std::uint32_t before = two.a.epoch, goal = two.a.send(ask::kBegin, begin(16));
  two.run(1);
  const auto at = [](double t) { return swing(t, 2.0); };
  for (int i = 0; i < 4; ++i) two.a.send(ask::kPart, part(60 * i, 60 * i + 60, at));
  two.run(50);
  assert_false(two.bench.generator.reference().standing());
  const std::uint32_t back = two.a.send(ask::kLease, RawMessage().number(1, 1));
  two.run(1000);
  assert_int_equal(two.a.status[back], 0);
  assert_int_equal(two.a.finals[goal], 1);
  assert_true(two.a.epoch > before);
  assert_true(two.bench.generator.reference().standing());
}

void waypoints_beyond_the_credit_end_their_trajectory(void**) {
  TwoClients& two = fresh_clients();
  two.a.lease();
  const std::uint32_t goal = two.a.send(ask::kBegin, begin(64));
  two.run(1);
  assert_int_equal(two.a.credit, 64 + kStagedWaypoints);
  std::uint32_t last = 0;
  const auto at = [](double t) { return swing(t, 2.0); };
  for (int i = 0; i < 6; ++i) last = two.a.send(ask::kPart, part(60 * i, 60 * i + 60, at));
  two.run(300);
  assert_int_equal(two.a.status[last], static_cast<int>(Status::kWindowFull));
  assert_int_equal(two.a.finals[goal], 1);
  assert_true(two.a.outcome[goal] == 16 || two.a.outcome[goal] == 12);  // REFUSED, ABORTED
  two.run(1000);
  assert_true(two.bench.generator.reference().standing());
}

void a_waypoint_that_is_refused_on_the_way_brings_the_arm_to_rest_and_is_named(void**) {
  TwoClients& two = fresh_clients();
  two.a.lease();
  const std::uint32_t goal = two.a.send(ask::kBegin, begin(64));
  two.run(1);
  for (int i = 0; i < 4; ++i)
    two.a.send(ask::kPart, part(60 * i, 60 * i + 60, [](double t) {
                 JointSpace::Point point = swing(t, 2.0);
                 if (t > 0.2) point.q[0] += 10.0;
                 return point;
               }));
  two.run(1500);
  assert_int_equal(two.a.finals[goal], 1);
  assert_int_equal(two.a.outcome[goal], 12);  // ABORTED
  assert_non_null(std::strstr(two.a.text, "waypoint 202"));
  assert_true(two.bench.generator.reference().standing());
}

void a_trajectory_is_refused_at_its_end_with_the_waypoint(void**) {
  TwoClients& two = fresh_clients();
  two.a.lease();
  const std::uint32_t goal = two.a.send(ask::kBegin, begin());
  two.run(1);
  two.a.send(ask::kPart, part(0, 50, [](double t) { return swing(t, 2.0); }));
  two.a.send(ask::kEnd);
  two.run(5);
  assert_int_equal(two.a.finals[goal], 1);
  assert_int_equal(two.a.outcome[goal], 16);  // REFUSED
  assert_non_null(std::strstr(two.a.text, "velocity"));
}

void a_trajectory_is_judged_without_a_lease_and_moves_nothing(void**) {
  TwoClients& two = fresh_clients();
  two.b.lease();
  for (const std::uint32_t window : {0U, 64U}) {
    const double durations_s[] = {1.5, 0.05};  // the second is too fast
    for (const double duration_s : durations_s) {
      two.a.credit = 0;
      const std::uint32_t goal = two.a.send(ask::kBegin, begin(window).number(9, 1));
      two.run(1);
      const int count = static_cast<int>(1e3 * duration_s) + 1;
      for (int at = 0; at < count; at += 50) {
        two.a.send(ask::kPart, part(at, std::min(at + 50, count), [&](double t) {
                     return t >= duration_s ? ServerBench::home() : swing(t, duration_s);
                   }));
        two.run(1);
      }
      two.a.send(ask::kEnd);
      two.run(5);
      assert_int_equal(two.a.finals[goal], 1);
      assert_int_equal(two.a.outcome[goal], duration_s > 0.1 ? 14 : 16);  // EXECUTED, REFUSED
    }
  }
  assert_true(two.bench.generator.reference().standing());
  assert_int_equal(two.bench.server.owner(), two.b.slot);
}

void a_check_waits_for_the_trajectory_that_comes_and_gives_way_to_it(void**) {
  TwoClients& two = fresh_clients();
  two.b.lease();
  const std::uint32_t check = two.a.send(ask::kBegin, begin().number(9, 1));
  two.run(1);
  const std::uint32_t goal = two.b.send(ask::kBegin, begin());
  two.run(1);
  assert_int_equal(two.a.finals[check], 1);
  assert_int_equal(two.a.outcome[check], 13);  // CANCELED
  const std::uint32_t again = two.a.send(ask::kBegin, begin().number(9, 1));
  two.run(1);
  assert_int_equal(two.a.status[again], static_cast<int>(Status::kNoFreeStore));
  assert_int_equal(two.b.status[goal], 0);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_trajectory_that_still_comes_ends_with_its_lease_and_its_epoch),
      cmocka_unit_test(ten_minutes_at_one_kilohertz_pass_through_a_window_of_512_without_a_gap),
      cmocka_unit_test(the_smallest_window_is_passed_to_its_end),
      cmocka_unit_test(waypoints_beyond_the_credit_end_their_trajectory),
      cmocka_unit_test(a_waypoint_that_is_refused_on_the_way_brings_the_arm_to_rest_and_is_named),
      cmocka_unit_test(a_trajectory_is_refused_at_its_end_with_the_waypoint),
      cmocka_unit_test(a_trajectory_is_judged_without_a_lease_and_moves_nothing),
      cmocka_unit_test(a_check_waits_for_the_trajectory_that_comes_and_gives_way_to_it),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
