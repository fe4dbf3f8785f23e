// Tests that a network that stalls costs a stop and nothing else: what it then delivers at once is
// answered, the newest counts, and the client goes on.
#include "tests/gateway/server/client_bench.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

// Proves GW-18.

constexpr auto kJoints = static_cast<std::size_t>(kDof);
constexpr double kSpeed = 0.3;  // of the first joint, rad/s

/// The kinds of stream.
enum class Kind { kPoints, kStampedPoints, kChunks, kVelocities, kCount };

double ramp(double time_s) {
  return ServerBench::home().q[0] + kSpeed * time_s;
}

/// Sends what a client makes at this time; a chunk is one of 30 targets for the next second.
std::uint32_t send(TestClient& client, Kind kind, double time_s, std::int64_t made_ns) {
  JointVector q = ServerBench::home().q;
  q[0] = ramp(time_s);
  RawMessage body;
  client.made_ns = made_ns;
  if (kind == Kind::kVelocities) {
    JointVector dq = JointVector::Zero();
    dq[0] = kSpeed;
    return client.send(ask::kVelocity, body.number(3, 200).reals(4, dq.data(), kJoints));
  }
  if (kind != Kind::kChunks) {
    body.message(3, RawMessage().reals(1, q.data(), kJoints));
    if (kind == Kind::kStampedPoints) body.time(7, made_ns);
    client.tells_time = kind == Kind::kPoints;  // when a message was sent stamps a point, too
    return client.send(ask::kPoint, body);
  }
  std::array<double, 30> times;
  std::array<double, 30 * kJoints> targets;
  for (std::size_t i = 0; i < times.size(); ++i) {
    times[i] = static_cast<double>(i) / 30.0;
    q[0] = ramp(time_s + times[i]);
    std::copy(q.data(), q.data() + kDof,
              targets.begin() + static_cast<std::ptrdiff_t>(i * kJoints));
  }
  body.time(4, made_ns).reals(9, times.data(), times.size());
  return client.send(ask::kChunk, body.reals(10, targets.data(), targets.size()));
}

/// What a stall of the network has cost.
struct Cost {
  int refused = 0, unanswered = 0;
  double back = 0.0;   // by how much the reference has gone back since the network delivers, rad
  double error = 0.0;  // from the ramp, in the end, rad
};

/// A client sends every `period_ms`; from 1 s on its messages are held back for `stall_ms`. Then
/// they come at once or, if `drip_ms` is given, one in each of these.
Cost stalled(Kind kind, int period_ms, int stall_ms, int drip_ms) {
  TwoClients& two = fresh_clients();
  two.a.lease(0, 60000);
  two.run(1);
  const std::int64_t start_ns = two.bench.now_ns;
  std::array<std::int64_t, 400> held{};
  int waits = 0;
  double farthest = -10.0;
  Cost cost;
  const std::uint32_t first = two.a.number + 1;
  for (int ms = 0; ms < 2000 + stall_ms; ++ms) {
    const bool stalls = ms >= 1000 && ms < 1000 + stall_ms;
    if (ms % period_ms == 0) held[static_cast<std::size_t>(waits++)] = two.bench.now_ns;
    int come = stalls ? 0 : waits;
    if (drip_ms > 0 && come > 1) come = ms % drip_ms == 0 ? 1 : 0;
    for (int i = 0; i < come; ++i) {
      const std::int64_t made_ns = held[static_cast<std::size_t>(i)];
      send(two.a, kind, 1e-9 * static_cast<double>(made_ns - start_ns), made_ns);
    }
    std::copy(held.begin() + come, held.begin() + waits, held.begin());
    waits -= come;
    two.run(1);
    const double q = two.bench.generator.reference().q[0];
    if (ms >= 1000 + stall_ms) cost.back = std::max(cost.back, farthest - q);
    farthest = ms < 1000 + stall_ms ? q : std::max(farthest, q);
    cost.error = std::abs(q - ramp(1e-9 * static_cast<double>(two.bench.now_ns - start_ns)));
  }
  two.run(20);
  for (std::uint32_t i = first; i <= two.a.number; ++i) {
    const auto late = static_cast<int>(Status::kChunkLate);
    if (two.a.status[i] != 0 || (two.a.outcome[i] == 16 && two.a.refusals[i] != late))
      ++cost.refused;
    if (two.a.answers[i] != 1 || (two.a.status[i] == 0 && two.a.finals[i] != 1)) ++cost.unanswered;
  }
  assert_int_equal(two.a.outcome[two.a.number], 14);  // EXECUTED
  return cost;
}

void after_a_stall_the_newest_counts_and_the_client_goes_on(void**) {
  double back = 0.0, error = 0.0;
  for (int kind = 0; kind < static_cast<int>(Kind::kCount); ++kind) {
    for (const int period_ms : {5, 10, 33, 50, 100}) {
      for (const int stall_ms : {100, 200, 400, 500, 800, 1500}) {
        for (const int drip_ms : {0, 1, 2}) {
          const Cost cost = stalled(static_cast<Kind>(kind), period_ms, stall_ms, drip_ms);
          assert_int_equal(cost.unanswered, 0);
          assert_int_equal(cost.refused, 0);
          back = std::max(back, cost.back);
          if (static_cast<Kind>(kind) != Kind::kVelocities) error = std::max(error, cost.error);
        }
      }
    }
  }
  print_message("at most %.4f rad back, %.4f rad off in the end\n", back, error);
  assert_true(back < 0.025);  // on the way back from beyond the last point, as the burst comes
  assert_true(error < 0.04);  // while the last of the burst come
}

/// Sends a chunk of 30 targets for the second that begins at `begin_s` from now.
std::uint32_t send_chunk(TwoClients& two, double begin_s) {
  return send(two.a, Kind::kChunks, 0.0,
              two.bench.now_ns + static_cast<std::int64_t>(1e9 * begin_s));
}

void a_plan_of_eight_chunks_ahead_is_full(void**) {
  TwoClients& two = fresh_clients();
  two.a.lease(0, 60000);
  two.run(1);
  std::uint32_t sent[9];
  for (int i = 0; i < 9; ++i) {
    sent[i] = send_chunk(two, 0.5 + i);
    two.run(2);
  }
  for (int i = 0; i < 8; ++i) assert_int_equal(two.a.outcome[sent[i]], 14);  // EXECUTED
  assert_int_equal(two.a.status[sent[8]], static_cast<int>(Status::kNoFreeStore));
  assert_non_null(std::strstr(two.a.text, "eight chunks are in force or wait"));
}

void whatever_begins_an_epoch_voids_the_reference_that_waits_for_space(void**) {
  for (const std::uint32_t by : {ask::kCancel, ask::kStop, ask::kLease}) {
    TwoClients& two = fresh_clients();
    two.a.lease(0, 60000);
    two.run(1);
    std::uint32_t last = 0;
    for (int i = 0; i < 12; ++i) last = send_chunk(two, 0.0);
    two.bench.server.work(two.bench.now_ns);
    two.b.send(by, by == ask::kLease ? RawMessage().number(2, 5) : RawMessage());
    two.run(5);
    assert_int_equal(two.a.status[last], 0);
    assert_int_equal(two.a.finals[last], 1);
    assert_int_equal(two.a.outcome[last], 15);  // SUPERSEDED
    const double before = two.bench.generator.reference().q[0];
    two.run(200);
    ASSERT_NEAR(two.bench.generator.reference().q[0], before, 1e-3);
  }
}

void a_policy_that_is_always_late_is_named_with_its_delay(void**) {
  TwoClients& two = fresh_clients();
  two.a.lease(0, 60000);
  two.b.send(ask::kSubscribe, RawMessage().number(3, 1));
  two.run(1);
  two.b.event[0] = '\0';
  for (int i = 0; i < 12; ++i) {
    send_chunk(two, -1.5);
    two.run(100);
    if (i < 10) assert_string_equal(two.b.event, "");
  }
  assert_non_null(std::strstr(two.a.text, "delay behind the last target 0.5"));
  assert_non_null(
      std::strstr(two.b.event, "A: the last 11 chunks came too late, the newest by 0.53"));
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(after_a_stall_the_newest_counts_and_the_client_goes_on),
      cmocka_unit_test(a_plan_of_eight_chunks_ahead_is_full),
      cmocka_unit_test(whatever_begins_an_epoch_voids_the_reference_that_waits_for_space),
      cmocka_unit_test(a_policy_that_is_always_late_is_named_with_its_delay),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
