// Tests the one rule of what is void: what was sent before a cancel, a stop or a takeover is in
// force does not move the arm, whatever it is, with or without a place, in every order of events.
#include "tests/gateway/server/client_bench.hpp"
#include "tests/gateway/server/trajectory_parts.hpp"

namespace tactus {
namespace {

// Proves GW-7.

enum class Kind { kPoint, kPointInPlace, kVelocity, kChunk, kTrajectory, kCount };
enum class By { kOwnCancel, kCancel, kStop, kTakeOver, kCount };

/// A reference that moves the first joint for more than a second.
struct Sender {
  TestClient& client;
  Kind kind;
  std::uint32_t number = 0;
  bool comes = false;  // the rest of a trajectory

  void begin() {
    JointVector q = ServerBench::home().q;
    q[0] += 2.0;
    RawMessage body;
    switch (kind) {
      case Kind::kPointInPlace:
        body.message(1, RawMessage().number(1, client.epoch).number(2, client.number + 1));
        [[fallthrough]];
      case Kind::kPoint:
        number =
            client.send(ask::kPoint, body.message(3, RawMessage().reals(1, q.data(), kJoints)));
        return;
      case Kind::kVelocity: {
        JointVector dq = JointVector::Zero();
        dq[0] = 0.3;
        number = client.send(ask::kVelocity, body.number(3, 5000).reals(4, dq.data(), kJoints));
        return;
      }
      case Kind::kChunk: return chunk(q);
      default: number = client.send(ask::kBegin, tactus::begin()); comes = true;
    }
  }
  /// From where the arm is at home, in 4 s.
  void chunk(JointVector q) {
    std::array<double, 40> times;
    std::array<double, 40 * kJoints> targets;
    for (std::size_t i = 0; i < times.size(); ++i) {
      times[i] = 0.1 * static_cast<double>(i);
      q[0] = ServerBench::home().q[0] + 0.3 * times[i];
      std::copy(q.data(), q.data() + kDof,
                targets.begin() + static_cast<std::ptrdiff_t>(i * kJoints));
    }
    RawMessage body;
    body.number(3, 1).reals(9, times.data(), times.size());
    number = client.send(ask::kChunk, body.reals(10, targets.data(), targets.size()));
  }
  /// After a turn of the server a trajectory has credit.
  void go_on() {
    if (!comes) return;
    comes = false;
    JointSpace::Point goal = ServerBench::home();
    goal.q[0] += 1.0;
    client.send(ask::kPart, part(3000, 3001, [&](double) { return goal; }));
    client.send(ask::kEnd);
  }
};

/// A turn of the server, after which both clients read.
void turn(TwoClients& two, Sender& sender) {
  two.bench.server.work(two.bench.now_ns);
  two.a.read();
  two.b.read();
  sender.go_on();
}

/// What happens between two places where something may be sent.
void pass(TwoClients& two, Sender& sender, int what) {
  if (what == 2) two.bench.step();
  if (what == 1) turn(two, sender);
}

bool moves(TwoClients& two) {
  const double before = two.bench.generator.reference().q[0];
  two.run(20);
  return std::abs(two.bench.generator.reference().q[0] - before) > 1e-4;
}

std::uint32_t end_by(TwoClients& two, By by) {
  switch (by) {
    case By::kOwnCancel: return two.a.send(ask::kCancel);
    case By::kCancel: return two.b.send(ask::kCancel);
    case By::kStop: return two.b.send(ask::kStop);
    default: return two.b.lease(9, 60000);
  }
}

/// Client A owns the motion and sends a reference at one of four places; what ends it comes at the
/// third. `order` says what happens between them.
void try_order(Kind kind, By by, int order, int place) {
  TwoClients& two = fresh_clients();
  two.a.lease(5, 60000);
  two.run(2);
  Sender sender = {two.a, kind};
  const int whole = order;
  TestClient& ender = by == By::kOwnCancel ? two.a : two.b;
  std::uint32_t end = 0;
  bool known = false;  // that it is in force, when the reference was sent
  for (int i = 0; i < 5; ++i) {
    if (i == 2) end = end_by(two, by);
    if (i == place) {
      known = end != 0 && ender.finals[end] == 1;
      sender.begin();
    }
    pass(two, sender, order % 3);
    order /= 3;
  }
  for (int i = 0; i < 3; ++i) {
    two.bench.step();
    turn(two, sender);
  }
  two.run(250);
  const bool void_ = by != By::kOwnCancel || !known;
  const bool moved = moves(two);
  if (moved == void_)
    print_message("kind %d, ended by %d, sent at place %d, known %d, order %d\n",
                  static_cast<int>(kind), static_cast<int>(by), place, known, whole);
  assert_int_equal(moved, !void_);
}

void what_was_sent_before_an_end_is_in_force_is_void_in_every_order(void**) {
  for (int kind = 0; kind < static_cast<int>(Kind::kCount); ++kind)
    for (int by = 0; by < static_cast<int>(By::kCount); ++by)
      for (int order = 0; order < 243; ++order)
        for (int place = 0; place < 5; ++place)
          try_order(static_cast<Kind>(kind), static_cast<By>(by), order, place);
}

void a_stream_without_places_ends_by_a_cancel_of_anybody_until_its_owner_takes_the_lease(void**) {
  TwoClients& two = fresh_clients();
  two.a.lease(5, 60000);
  JointVector q = ServerBench::home().q;
  std::uint32_t last = 0;
  const auto stream = [&](int points) {
    for (int i = 0; i < points; ++i) {
      q[0] += 0.002;
      last = two.a.point(q);
      two.run(10);
    }
  };
  stream(50);
  two.b.send(ask::kCancel);
  stream(20);
  const double rest = two.bench.generator.reference().q[0];
  stream(20);
  ASSERT_NEAR(two.bench.generator.reference().q[0], rest, 0.0);
  assert_int_equal(two.a.status[last], static_cast<int>(Status::kEpochVoid));
  assert_non_null(std::strstr(two.a.text, "another client has canceled it; take the lease again"));
  two.a.lease(5, 60000);
  stream(50);
  assert_true(two.bench.generator.reference().q[0] > rest + 0.05);
}

/// Where the arm ends after a point with a velocity, or a chunk of one; `after` another client's
/// stream whose lease was given back.
double end_of_one(bool chunk, bool after) {
  TwoClients& two = fresh_clients();
  const auto send = [chunk](TestClient& client, double x, double speed) {
    JointVector q = ServerBench::home().q, dq = JointVector::Zero();
    q[0] += x;
    dq[0] = speed;
    constexpr double kNow = 0.0;
    RawMessage body;
    if (chunk)
      client.send(ask::kChunk, body.number(3, 1)
                                   .reals(9, &kNow, 1)
                                   .reals(10, q.data(), kJoints)
                                   .reals(11, dq.data(), kJoints));
    else
      client.send(
          ask::kPoint,
          body.message(3, RawMessage().reals(1, q.data(), kJoints).reals(2, dq.data(), kJoints)));
  };
  two.a.lease(5, 60000);
  for (int k = 1; after && k <= 20; ++k) {
    send(two.a, 0.002 * k, 0.2);
    two.run(10);
  }
  two.a.send(ask::kLease, RawMessage().number(1, 1));
  two.b.lease(5, 60000);
  send(two.b, 0.05, -0.1);
  two.run(1000);
  assert_true(two.bench.generator.reference().standing());
  return two.bench.generator.reference().q[0];
}

void who_takes_a_lease_that_was_given_back_begins_anew(void**) {
  for (const bool chunk : {false, true})
    ASSERT_NEAR(end_of_one(chunk, true), end_of_one(chunk, false), 1e-4);
}

void what_comes_with_a_takeover_is_executed(void**) {
  for (int kind = 0; kind < static_cast<int>(Kind::kCount); ++kind) {
    if (static_cast<Kind>(kind) == Kind::kPointInPlace) continue;  // it names the epoch before
    TwoClients& two = fresh_clients();
    two.a.lease(5, 60000);
    Sender first = {two.a, Kind::kVelocity}, second = {two.b, static_cast<Kind>(kind)};
    first.begin();
    two.run(3);
    first.begin();
    two.b.lease(9, 60000);
    second.begin();
    turn(two, second);
    two.run(500);
    assert_true(moves(two));
  }
}

void a_trajectory_behind_a_pause_and_a_cancel_is_told_that_the_pause_holds(void**) {
  for (const bool pauses : {false, true}) {
    TwoClients& two = fresh_clients();
    two.a.lease(5, 60000);
    if (pauses) two.b.send(ask::kPause);
    two.run(2);
    two.a.send(ask::kCancel);
    two.run(2);
    Sender sender = {two.a, Kind::kTrajectory};
    sender.begin();
    turn(two, sender);
    two.run(500);
    assert_int_equal(two.a.started[sender.number], pauses ? static_cast<int>(Status::kPaused) : 0);
    if (pauses) assert_non_null(std::strstr(two.a.text, "a pause holds the arm (61); send Resume"));
    assert_int_equal(moves(two), !pauses);
    two.a.send(ask::kResume);
    two.run(500);
    assert_true(moves(two));
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(what_was_sent_before_an_end_is_in_force_is_void_in_every_order),
      cmocka_unit_test(
          a_stream_without_places_ends_by_a_cancel_of_anybody_until_its_owner_takes_the_lease),
      cmocka_unit_test(who_takes_a_lease_that_was_given_back_begins_anew),
      cmocka_unit_test(what_comes_with_a_takeover_is_executed),
      cmocka_unit_test(a_trajectory_behind_a_pause_and_a_cancel_is_told_that_the_pause_holds),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
