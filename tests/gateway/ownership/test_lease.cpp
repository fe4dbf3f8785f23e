// Tests the table of ownership in docs/gateway.md, in every order of what can happen.
#include "gateway/server/generator_clock.hpp"
#include "gateway/server/lease.hpp"
#include "tests/gateway/server/client_bench.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr std::int64_t kTimeout_ns = 100 * kMillisecond_ns;

/// The table, as a state of its own: who owns with which priority, and since when silent.
struct Table {
  int owner = -1;
  int priority = 0;
  std::int64_t heard_ns = 0;

  LeaseResult take(int client, int wish, std::int64_t now_ns) {
    if (owner >= 0 && owner != client && wish <= priority) return LeaseResult::kRefused;
    const LeaseResult taken = owner < 0         ? LeaseResult::kFree
                              : owner == client ? LeaseResult::kRenewed
                                                : LeaseResult::kTakenOver;
    owner = client;
    priority = wish;
    heard_ns = now_ns;
    return taken;
  }
};

// Proves GW-3.

void every_sequence_of_six_events_of_two_clients_ends_as_the_table_says(void**) {
  constexpr int kEvents = 9, kLength = 6;
  int sequences = 1;
  for (int i = 0; i < kLength; ++i) sequences *= kEvents;
  for (int sequence = 0; sequence < sequences; ++sequence) {
    Lease lease;
    Table table;
    std::int64_t now_ns = 1000 * kSecond_ns;
    for (int i = 0, left = sequence; i < kLength; ++i, left /= kEvents) {
      const int event = left % kEvents, client = event % 2;
      now_ns += 40 * kMillisecond_ns;
      if (event < 4) {  // take, with priority 1 or 2
        const int priority = 1 + event / 2;
        const LeaseResult taken =
            lease.take(client, static_cast<std::uint32_t>(priority), kTimeout_ns, now_ns);
        ASSERT_STATUS(taken, table.take(client, priority, now_ns));
      } else if (event < 6) {  // a message
        lease.heard(client, now_ns);
        if (table.owner == client) table.heard_ns = now_ns;
      } else if (event < 8) {  // give back, or leave
        if (lease.owner() == client) lease.end();
        if (table.owner == client) table.owner = -1;
      } else {  // a silence
        now_ns += 70 * kMillisecond_ns;
      }
      const bool over = table.owner >= 0 && now_ns - table.heard_ns > kTimeout_ns;
      assert_int_equal(lease.expired(now_ns), over);
      if (over) {
        lease.end();
        table.owner = -1;
      }
      assert_int_equal(lease.owner(), table.owner);
    }
  }
}

void only_the_owner_moves_the_arm_and_everybody_may_stop_it(void**) {
  TwoClients& two = fresh_clients();
  const JointVector home = ServerBench::home().q;
  const std::uint32_t first = two.a.point(home);
  two.run(2);
  assert_int_equal(two.a.status[first], static_cast<int>(Status::kNotOwner));
  two.a.lease(5);
  two.run(1);
  for (const std::uint32_t kind : {ask::kVelocity, ask::kChunk, ask::kBegin, ask::kPart, ask::kEnd,
                                   ask::kResume, ask::kRearm, ask::kTare}) {
    const std::uint32_t number = two.b.send(kind);
    two.run(2);
    assert_int_equal(two.b.status[number], static_cast<int>(Status::kNotOwner));
    assert_int_equal(two.b.finals[number], 0);
  }
  assert_non_null(std::strstr(two.b.text, "A, with priority 5"));
  const std::uint32_t point = two.a.point(home), stop = two.b.send(ask::kStop);
  two.run(3);
  assert_int_equal(two.a.finals[point], 1);
  assert_int_equal(two.b.status[stop], 0);
  assert_int_equal(two.b.finals[stop], 1);
  assert_true(two.bench.rung == Rung::kDisabled);
}

void a_take_over_brings_the_arm_to_rest_and_tells_both(void**) {
  TwoClients& two = fresh_clients();
  two.a.send(ask::kSubscribe, RawMessage().number(3, 1));
  two.a.lease(1);
  JointVector far = ServerBench::home().q;
  far[0] += 0.5;
  two.a.point(far);
  two.run(100);
  assert_false(two.bench.generator.reference().standing());
  const std::uint32_t same = two.b.lease(1);
  two.run(1);
  assert_int_equal(two.b.status[same], static_cast<int>(Status::kNotOwner));
  assert_non_null(std::strstr(two.b.text, "A owns the motion with priority 1"));
  const std::uint32_t higher = two.b.lease(2);
  two.run(1);
  assert_int_equal(two.b.status[higher], 0);
  assert_int_equal(two.bench.server.owner(), two.b.slot);
  assert_string_equal(two.a.event, "B owns the motion, taken over from A");
  two.run(1000);
  assert_true(two.bench.generator.reference().standing());
  assert_true(two.bench.generator.reference().q[0] < far[0] - 0.1);
}

void a_lease_that_is_not_renewed_ends_and_the_arm_rests_while_messages_renew_it(void**) {
  TwoClients& two = fresh_clients();
  two.a.lease(0, 100);
  JointVector far = ServerBench::home().q;
  far[0] += 2.0;
  two.a.point(far);
  for (int i = 0; i < 5; ++i) {
    two.run(90);
    two.a.send(ask::kPing);
  }
  assert_int_equal(two.bench.server.owner(), two.a.slot);
  assert_false(two.bench.generator.reference().standing());
  two.run(102);
  assert_int_equal(two.bench.server.owner(), Lease::kNoOwner);
  two.run(1000);
  assert_true(two.bench.generator.reference().standing());
  assert_true(two.bench.generator.reference().q[0] < far[0] - 0.1);
}

void what_runs_goes_on_when_its_owner_gives_the_lease_back(void**) {
  TwoClients& two = fresh_clients();
  two.a.lease();
  JointVector far = ServerBench::home().q;
  far[0] += 0.3;
  two.a.point(far);
  two.run(5);
  const std::uint32_t back = two.a.send(ask::kLease, RawMessage().number(1, 1));
  two.run(3000);
  assert_int_equal(two.a.status[back], 0);
  ASSERT_NEAR(two.bench.generator.reference().q[0], far[0], 1e-9);
  const std::uint32_t again = two.a.send(ask::kLease, RawMessage().number(1, 1));
  two.run(1);
  assert_int_equal(two.a.status[again], static_cast<int>(Status::kNotOwner));
}

void a_take_over_stops_an_arm_whose_owner_has_filled_the_mailbox_of_controls(void**) {
  TwoClients& two = fresh_clients();
  two.a.lease(1);
  JointVector far = ServerBench::home().q;
  far[0] += 2.0;
  two.a.point(far);
  two.run(100);
  for (int i = 0; i < 20; ++i) two.a.send(ask::kOverride, RawMessage().real(1, 0.5));
  two.b.lease(2);
  const std::uint32_t early = two.b.point(far);
  two.bench.server.work(two.bench.now_ns);
  two.b.read();
  assert_int_equal(two.b.status[early], static_cast<int>(Status::kMailboxFull));
  two.run(1000);
  assert_true(two.bench.generator.reference().standing());
  assert_true(two.bench.generator.reference().q[0] < far[0] - 0.1);
}

void leases_outside_their_ranges_are_refused(void**) {
  TwoClients& two = fresh_clients();
  for (const std::uint32_t timeout_ms : {1U, 19U, 60'001U}) {
    const std::uint32_t number = two.a.lease(0, timeout_ms);
    two.run(1);
    assert_int_equal(two.a.status[number], static_cast<int>(Status::kBadValue));
  }
  const std::uint32_t number = two.a.lease(256);
  two.run(1);
  assert_int_equal(two.a.status[number], static_cast<int>(Status::kBadValue));
  assert_int_equal(two.bench.server.owner(), Lease::kNoOwner);
}

// Proves GW-8.

void stamps_are_times_of_the_generator_also_after_cycles_were_left_out(void**) {
  GeneratorClock clock;
  double time_s = -1.0;
  ASSERT_STATUS(clock.time_of(5, 5, time_s).status, Status::kNotStarted);
  const std::int64_t begin_ns = 7'000 * kSecond_ns;
  clock.set(begin_ns, 2.0);
  assert_true(clock.time_of(begin_ns + 250 * kMillisecond_ns, begin_ns, time_s).ok());
  ASSERT_NEAR(time_s, 2.25, 1e-9);
  assert_true(clock.time_of(begin_ns - 250 * kMillisecond_ns, begin_ns, time_s).ok());
  ASSERT_NEAR(time_s, 1.75, 1e-9);
  clock.set(begin_ns + 100 * kMillisecond_ns, 2.09);  // ten periods were left out
  assert_true(clock.time_of(begin_ns + 200 * kMillisecond_ns, begin_ns, time_s).ok());
  ASSERT_NEAR(time_s, 2.19, 1e-9);
}

void a_stamp_more_than_ten_seconds_off_is_refused_with_its_distance(void**) {
  GeneratorClock clock;
  const std::int64_t now_ns = 7'000 * kSecond_ns;
  clock.set(now_ns, 2.0);
  double time_s = -1.0;
  assert_true(clock.time_of(now_ns + 10 * kSecond_ns, now_ns, time_s).ok());
  for (const std::int64_t off_ns : {10 * kSecond_ns + 1'000'000, -10 * kSecond_ns - 1'000'000}) {
    const Verdict verdict = clock.time_of(now_ns + off_ns, now_ns, time_s);
    ASSERT_STATUS(verdict.status, Status::kStampRange);
    ASSERT_NEAR(verdict.value, static_cast<double>(off_ns) * 1e-9, 1e-6);
  }
  for (const std::int64_t stamp_ns : {INT64_MIN, INT64_MAX})
    ASSERT_STATUS(clock.time_of(stamp_ns, now_ns, time_s).status, Status::kStampRange);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(every_sequence_of_six_events_of_two_clients_ends_as_the_table_says),
      cmocka_unit_test(only_the_owner_moves_the_arm_and_everybody_may_stop_it),
      cmocka_unit_test(a_take_over_brings_the_arm_to_rest_and_tells_both),
      cmocka_unit_test(a_lease_that_is_not_renewed_ends_and_the_arm_rests_while_messages_renew_it),
      cmocka_unit_test(what_runs_goes_on_when_its_owner_gives_the_lease_back),
      cmocka_unit_test(a_take_over_stops_an_arm_whose_owner_has_filled_the_mailbox_of_controls),
      cmocka_unit_test(leases_outside_their_ranges_are_refused),
      cmocka_unit_test(stamps_are_times_of_the_generator_also_after_cycles_were_left_out),
      cmocka_unit_test(a_stamp_more_than_ten_seconds_off_is_refused_with_its_distance),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
