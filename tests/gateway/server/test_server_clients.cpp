// Tests two clients in random orders, and clients that die at any moment.
#include "tests/gateway/server/trajectory_parts.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

bool moves(std::uint32_t kind) {
  return kind == ask::kPoint || kind == ask::kVelocity || kind == ask::kChunk ||
         (kind >= ask::kBegin && kind <= ask::kResume) || kind == ask::kRearm ||
         kind == ask::kParameters || kind == ask::kTare;
}
/// True if everybody may send it, an override only if it is lower than that before.
bool slows(std::uint32_t kind) {
  return kind == ask::kCancel || kind == ask::kOverride || kind == ask::kPause;
}
/// True if a message that is taken is reported besides.
bool reported(std::uint32_t kind) {
  return moves(kind) ? kind != ask::kPart && kind != ask::kEnd : kind == ask::kStop;
}

RawMessage body_of(std::uint32_t kind, TestClient& client, Random& random) {
  JointVector q = ServerBench::home().q;
  q[0] += random.uniform(-0.2, 0.2);
  RawMessage place;
  place.number(1, client.epoch).number(2, client.number);
  RawMessage body;
  switch (kind) {
    case ask::kLease:
      return body.number(1, random.below(3) == 0).number(2, static_cast<unsigned>(random.below(3)));
    case ask::kPoint:
      return body.message(1, place).message(3, RawMessage().reals(1, q.data(), kJoints));
    case ask::kVelocity: {
      const JointVector slow = JointVector::Constant(random.uniform(-0.1, 0.1));
      return body.message(1, place).number(3, 20).reals(4, slow.data(), kJoints);
    }
    case ask::kChunk: {
      double times[2] = {0.05, 0.1}, targets[2 * kJoints];
      for (std::size_t i = 0; i < 2 * kJoints; ++i) targets[i] = q[static_cast<int>(i % kJoints)];
      return body.message(1, place).number(3, 1).reals(9, times, 2).reals(10, targets, 2 * kJoints);
    }
    case ask::kBegin: return begin(static_cast<std::uint32_t>(random.below(2) * 40));
    case ask::kPart: {
      const int first = random.below(40);
      return part(first, first + 1 + random.below(59), [](double t) { return swing(t, 0.5); });
    }
    case ask::kOverride: return body.real(1, random.uniform(0.0, 1.2));
    case ask::kParameters: {
      constexpr const char* kValues[] = {"50", "200", "-1"};
      return body.message(
          2, RawMessage().text(1, "pd").text(2, "kp").text(3, kValues[random.below(3)]));
    }
    default: return body;
  }
}

/// The messages of one client: all were answered once, and what was taken was reported once.
void assert_accounted(const TestClient& client) {
  for (std::uint32_t i = 1; i <= client.number; ++i) {
    if (client.answers[i] != 1)
      print_error("message %u of kind %u was answered %d times\n", i, client.kinds[i],
                  client.answers[i]);
    assert_int_equal(client.answers[i], 1);
    const int finals = client.status[i] == 0 && reported(client.kinds[i]) ? 1 : 0;
    if (client.finals[i] != finals)
      print_error("message %u of kind %u, status %d, was reported %d times\n", i, client.kinds[i],
                  client.status[i], client.finals[i]);
    assert_int_equal(client.finals[i], finals);
  }
}

// Proves GW-2, GW-3.

void of_two_clients_in_a_thousand_orders_every_message_is_answered_once_and_only_the_owner_moves(
    void**) {
  constexpr std::uint32_t kKinds[] = {
      ask::kLease,      ask::kPoint, ask::kVelocity,  ask::kChunk, ask::kBegin,
      ask::kPart,       ask::kEnd,   ask::kPart,      ask::kEnd,   ask::kCancel,
      ask::kOverride,   ask::kPause, ask::kResume,    ask::kStop,  ask::kRearm,
      ask::kParameters, ask::kPing,  ask::kSubscribe, ask::kLease, ask::kTare};
  Random random{18};
  int taken = 0, refused = 0;
  for (int batch = 0; batch < 50; ++batch) {
    TwoClients& two = fresh_clients();
    for (int order = 0; order < 20; ++order) {
      for (int i = 0; i < 30; ++i) {
        TestClient& client = random.below(2) == 0 ? two.a : two.b;
        const std::uint32_t kind = kKinds[random.below(static_cast<int>(std::size(kKinds)))];
        if (kind == ask::kStop && random.below(3) != 0) continue;
        const bool owned = two.bench.server.owner() == client.slot;
        const std::uint32_t number = client.send(kind, body_of(kind, client, random));
        two.bench.server.work(two.bench.now_ns);
        two.a.read();
        two.b.read();
        assert_int_equal(client.answers[number], 1);
        const auto status = static_cast<Status>(client.status[number]);
        if (moves(kind) && !slows(kind)) assert_int_equal(status == Status::kNotOwner, !owned);
        if (slows(kind) && (owned || kind != ask::kOverride))
          assert_true(status != Status::kNotOwner);
        if (moves(kind)) ++(status == Status::kOk ? taken : refused);
        two.run(random.below(4));
      }
    }
    two.a.lease(200);
    two.a.send(ask::kRearm);
    two.run(2);
    two.a.send(ask::kResume);
    two.a.send(ask::kOverride, RawMessage().real(1, 1.0));
    two.a.send(ask::kBegin);  // ends one that has begun
    two.a.send(ask::kCancel);
    two.run(900);
    assert_accounted(two.a);
    assert_accounted(two.b);
  }
  assert_true(taken > 2000);
  assert_true(refused > 5000);
}

// Proves GW-4.

void a_client_that_dies_at_any_moment_leaves_the_arm_at_rest_and_the_lease_free(void**) {
  Random random{4};
  TwoClients& two = fresh_clients();
  for (int death = 0; death < 200; ++death) {
    two.a.close();
    two.a.greet("A");
    two.a.lease();
    const int moment = random.below(400), how = random.below(3);
    RawMessage velocity;
    const JointVector slow = JointVector::Constant(0.1);
    velocity.number(3, 10'000).reals(4, slow.data(), kJoints);
    JointVector far = ServerBench::home().q;
    far[1] += 0.4;
    if (how == 0) two.a.send(ask::kBegin, begin(100));
    if (how == 1) two.a.point(far);
    if (how == 2) two.a.send(ask::kVelocity, velocity);
    for (int ms = 0, sent = 0; ms < moment; ++ms) {
      if (how == 0 && two.a.credit >= 30 && sent < 1470) {
        two.a.send(ask::kPart, part(sent, sent + 30, [](double t) { return swing(t, 1.5); }));
        two.a.credit -= 30;
        sent += 30;
      }
      two.run(1);
    }
    const std::uint8_t torn[] = {200, 0, 0, 0, 1, 2, 3};
    two.a.push(torn, static_cast<std::size_t>(random.below(8)));
    two.a.close();
    two.b.send(ask::kPing);
    two.run(1);
    assert_int_equal(two.bench.server.owner(), Lease::kNoOwner);
    two.run(1000);
    assert_true(two.bench.generator.reference().standing());
    const std::uint32_t lease = two.b.lease();
    const std::uint32_t point = two.b.point(ServerBench::home().q);
    two.run(2000);
    assert_int_equal(two.b.status[lease], 0);
    assert_int_equal(two.b.finals[point], 1);
    ASSERT_NEAR(two.bench.generator.reference().q[1], ServerBench::home().q[1], 1e-9);
    two.b.send(ask::kLease, RawMessage().number(1, 1));
    two.run(1);
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(
          of_two_clients_in_a_thousand_orders_every_message_is_answered_once_and_only_the_owner_moves),
      cmocka_unit_test(a_client_that_dies_at_any_moment_leaves_the_arm_at_rest_and_the_lease_free),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
