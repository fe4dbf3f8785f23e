// Tests two clients in random orders, clients that die at any moment, and long trajectories.
#include "tests/gateway/server_bench.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr auto kJoints = static_cast<std::size_t>(kDof);

bool moves(std::uint32_t kind) {
  return kind == ask::kPoint || kind == ask::kVelocity || kind == ask::kChunk ||
         (kind >= ask::kBegin && kind <= ask::kResume) || kind == ask::kRearm;
}
/// True if a message that is taken is reported besides.
bool reported(std::uint32_t kind) {
  return moves(kind) ? kind != ask::kPart && kind != ask::kEnd : kind == ask::kStop;
}

/// A swing of joint 1 about home, at rest at both ends: 0.2 sin^3 (pi t / T).
JointSpace::Point swing(double t, double duration_s) {
  const double w = 3.14159265358979323846 / duration_s, s = std::sin(w * t), c = std::cos(w * t);
  JointSpace::Point point = ServerBench::home();
  point.q[0] += 0.2 * s * s * s;
  point.dq[0] = 0.6 * w * s * s * c;
  point.ddq[0] = 0.6 * w * w * (2.0 * s * c * c - s * s * s);
  return point;
}

/// Waypoints `first` to `last` at 1 kHz, of `at(t)`, with velocities and accelerations.
template <class At>
RawMessage part(int first, int last, At at) {
  static std::array<double, 60> times;
  static std::array<double, 60 * 3 * kJoints> numbers;
  std::size_t count = 0;
  for (int i = first; i < last; ++i, ++count) {
    const JointSpace::Point point = at(1e-3 * i);
    times[count] = 1e-3 * i;
    for (std::size_t k = 0; k < kJoints; ++k) {
      numbers[3 * kJoints * count + k] = point.q[static_cast<int>(k)];
      numbers[3 * kJoints * count + kJoints + k] = point.dq[static_cast<int>(k)];
      numbers[3 * kJoints * count + 2 * kJoints + k] = point.ddq[static_cast<int>(k)];
    }
  }
  RawMessage message;
  message.reals(1, times.data(), count).reals(2, numbers.data(), 3 * kJoints * count);
  return message;
}

RawMessage begin(std::uint32_t window = 0) {
  return RawMessage().number(6, 1).number(7, 1).number(10, window);
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
      ask::kParameters, ask::kPing,  ask::kSubscribe, ask::kLease};
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
        if (moves(kind)) assert_int_equal(status == Status::kNotOwner, !owned);
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
    assert_int_equal(two.bench.server.owner(), Lease::kNobody);
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

// Proves GW-6.

void ten_minutes_at_one_kilohertz_pass_through_a_window_of_512_without_a_gap(void**) {
  constexpr int kWaypoints = 600'001;
  const auto at = [](double t) {
    const double whole_s = 600.0;
    JointSpace::Point point = swing(std::fmod(t, 3.0), 3.0);
    return t >= whole_s ? point.at_rest() : point;
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
    const bool follows = two.bench.generator.phase() == Phase::kFollowing;
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

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(
          of_two_clients_in_a_thousand_orders_every_message_is_answered_once_and_only_the_owner_moves),
      cmocka_unit_test(a_client_that_dies_at_any_moment_leaves_the_arm_at_rest_and_the_lease_free),
      cmocka_unit_test(ten_minutes_at_one_kilohertz_pass_through_a_window_of_512_without_a_gap),
      cmocka_unit_test(waypoints_beyond_the_credit_end_their_trajectory),
      cmocka_unit_test(a_waypoint_that_is_refused_on_the_way_brings_the_arm_to_rest_and_is_named),
      cmocka_unit_test(a_trajectory_is_refused_at_its_end_with_the_waypoint),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
