// Tests that nothing which was on its way undoes what another client, or a fault, has stopped
// since.
#include <vector>

#include "gateway/server/lease.hpp"
#include "tests/gateway/server/client_bench.hpp"
#include "tests/support/random.hpp"
#include "tests/support/trials.hpp"

namespace tactus {
namespace {

// Proves GW-20.

/// The rule, from the whole list: all stops but the client's own are among the first `told`.
void the_count_is_that_of_a_list_of_all_stops(void**) {
  Random random{60};
  for (int trial = trials(2000); trial > 0; --trial) {
    StopCount count;
    std::vector<int> by = {-1};
    for (int k = 0; k < 30; ++k) {
      const int client = random.below(3);
      if (random.below(2) == 0) {
        count.add(static_cast<std::uint64_t>(client));
        by.push_back(client);
      }
      const auto told = static_cast<std::size_t>(random.below(static_cast<int>(by.size()) + 2));
      bool known = told >= 1 && told <= by.size();
      for (std::size_t i = told; i < by.size(); ++i) known = known && by[i] == client;
      assert_int_equal(count.newest(), by.size());
      assert_int_equal(
          count.known(static_cast<std::uint32_t>(told), static_cast<std::uint64_t>(client)), known);
    }
  }
}

struct Event {
  std::uint32_t kind;
  double rate = 0.0;
};
constexpr Event kStops[] = {{ask::kStop}, {ask::kCancel}, {ask::kPause}, {ask::kOverride, 0.2}};
constexpr Event kMoves[] = {{ask::kRearm}, {ask::kResume}, {ask::kOverride, 0.9}};

/// A owns the motion and sends what makes the arm move again over a link that holds it up; B has
/// stopped it before A asks, while it is on its way, or not at all.
std::uint8_t answered(const Event& move, const Event& stop, bool before, bool later) {
  TwoClients& two = fresh_clients();
  two.a.lease(5, 60000);
  two.a.send(ask::kOverride, RawMessage().real(1, 0.5));
  two.run(2);
  if (before) two.b.control(stop.kind, stop.rate);
  two.run(100);
  two.a.send(ask::kPing);
  two.run(2);
  const std::uint32_t told = two.a.stops;
  if (later) two.b.control(stop.kind, stop.rate);
  two.run(100);
  two.a.stops = told;
  const std::uint32_t number = two.a.control(move.kind, move.rate);
  two.run(100);
  if (later) {
    if (stop.kind == ask::kStop) ASSERT_STATUS(two.bench.rung, Rung::kDisabled);
    if (two.a.status[number] != 0)
      assert_non_null(std::strstr(two.a.text, "slowed down, not by this client"));
  }
  return two.a.status[number];
}

void what_was_asked_before_anothers_stop_does_not_move_the_arm(void**) {
  for (const Event& move : kMoves) {
    for (const Event& stop : kStops) {
      constexpr auto kVoid = static_cast<std::uint8_t>(Status::kEpochVoid);
      assert_int_equal(answered(move, stop, false, true), kVoid);
      assert_int_equal(answered(move, stop, true, true), kVoid);
      assert_int_not_equal(answered(move, stop, true, false), kVoid);
      assert_int_not_equal(answered(move, stop, false, false), kVoid);
    }
  }
}

/// Neither does a fault, nor a lease that was lost and taken again, while it was on its way.
void what_was_asked_before_a_fault_or_a_lost_lease_does_not_move_the_arm(void**) {
  for (const bool fault : {false, true}) {
    TwoClients& two = fresh_clients();
    two.a.lease(5, fault ? 60000 : 50);
    two.a.control(ask::kPause);
    two.run(2);
    const std::uint32_t told = two.a.stops;
    two.bench.why = Status::kCollision;
    if (fault) two.bench.rung = Rung::kDisabled;
    two.bench.faults = fault ? 1 : 0;
    two.run(100);
    two.a.lease(5, 60000);
    two.run(2);
    two.a.stops = told;
    const std::uint32_t number = two.a.send(fault ? ask::kRearm : ask::kResume);
    two.run(2);
    assert_int_equal(two.a.status[number], static_cast<int>(Status::kEpochVoid));
  }
}

/// One connection keeps its order: its own stop does not void what comes behind it.
void ones_own_stop_is_known(void**) {
  TwoClients& two = fresh_clients();
  two.a.lease(5, 60000);
  two.run(2);
  for (const Event& stop : kStops) {
    const std::uint32_t told = two.a.stops;
    two.a.control(stop.kind, stop.rate);
    two.run(100);
    two.a.stops = told;
    const std::uint32_t number = two.a.send(ask::kRearm);
    two.run(2);
    assert_int_not_equal(two.a.status[number], static_cast<int>(Status::kEpochVoid));
    two.run(400);
  }
}

void what_does_not_say_what_it_knows_is_refused(void**) {
  for (const Event& move : kMoves) {
    TwoClients& two = fresh_clients();
    two.a.lease(5, 60000);
    two.a.send(ask::kOverride, RawMessage().real(1, 0.5));
    two.run(100);
    for (const std::uint32_t told : {0U, two.a.stops + 1, ~0U}) {
      two.a.stops = told;
      const std::uint32_t number = two.a.control(move.kind, move.rate);
      two.run(2);
      assert_int_equal(two.a.status[number], static_cast<int>(Status::kBadValue));
      assert_non_null(std::strstr(two.a.text, "stops is missing or was never told"));
    }
  }
}

void an_override_that_lowers_needs_no_word(void**) {
  TwoClients& two = fresh_clients();
  two.a.lease(5, 60000);
  two.run(2);
  two.a.names_stops = false;
  const std::uint32_t number = two.a.send(ask::kOverride, RawMessage().real(1, 0.5));
  two.run(2);
  assert_int_equal(two.a.status[number], 0);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_count_is_that_of_a_list_of_all_stops),
      cmocka_unit_test(what_was_asked_before_anothers_stop_does_not_move_the_arm),
      cmocka_unit_test(what_was_asked_before_a_fault_or_a_lost_lease_does_not_move_the_arm),
      cmocka_unit_test(ones_own_stop_is_known),
      cmocka_unit_test(what_does_not_say_what_it_knows_is_refused),
      cmocka_unit_test(an_override_that_lowers_needs_no_word),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
