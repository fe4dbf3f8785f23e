// Tests which references of a client move the arm, and when.
#include "tests/gateway/server/client_bench.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

// Proves GW-7.

void a_point_moves_the_reference_in_the_next_cycle(void**) {
  TwoClients& two = fresh_clients();
  two.a.lease();
  two.run(1);
  JointVector q = ServerBench::home().q;
  q[0] += 0.1;
  two.a.point(q);
  two.bench.server.work(two.bench.now_ns);
  two.bench.cycle();
  assert_false(two.bench.generator.reference().standing() &&
               two.bench.generator.phase() == MotionPhase::kHolding);
  two.bench.cycle();
  assert_true(two.bench.generator.reference().q[0] > ServerBench::home().q[0]);
}

/// Returns by how much the velocity differs from a ramp of 0.3 rad/s, of which every third point is
/// lost, once it is followed, rad/s.
double off_ramp(std::int64_t first_ns) {
  TwoClients& two = fresh_clients();
  two.a.lease(0, 60000);
  two.run(1);
  double off = 0.0;
  for (int k = 0; k < 60; ++k) {
    JointVector q = ServerBench::home().q;
    q[0] += 0.3 * 0.02 * k;
    RawMessage point;
    point.message(3, RawMessage().reals(1, q.data(), static_cast<std::size_t>(kDof)));
    two.a.tells_time = false;
    if (first_ns != 0) point.time(7, first_ns + 20'000'000 * k);
    if (k % 3 != 2) two.a.send(ask::kPoint, point);
    for (int cycle = 0; cycle < 20; ++cycle) {
      two.run(1);
      if (k > 30) off = std::max(off, std::abs(two.bench.generator.reference().dq[0] - 0.3));
    }
  }
  print_message("%.5f rad/s off\n", off);
  return off;
}

// Proves RG-22.

void points_with_stamps_are_followed_evenly(void**) {
  using Limits = std::numeric_limits<std::int64_t>;
  for (const std::int64_t first_ns : {std::int64_t{1}, std::int64_t{-500'000'001}})
    assert_true(off_ramp(first_ns) < 1e-3);
  // 2 us is the resolution of so large a number of seconds.
  for (const std::int64_t first_ns : {Limits::min(), Limits::max() - 2'000'000'000})
    assert_true(off_ramp(first_ns) < 1e-3);
  assert_true(off_ramp(0) > 0.005);
}

void what_a_stop_voids_does_not_move_the_arm(void**) {
  TwoClients& two = fresh_clients();
  two.a.lease();
  two.run(1);
  const std::uint32_t before = two.a.epoch;
  two.stop_and_rearm();
  assert_true(two.bench.rung == Rung::kNominal);
  JointVector q = ServerBench::home().q;
  q[0] += 0.1;
  RawMessage target;
  target.message(3, RawMessage().reals(1, q.data(), static_cast<std::size_t>(kDof)));
  RawMessage old = target, present = target;
  old.message(1, RawMessage().number(1, before).number(2, 1));
  const std::uint32_t stale = two.a.send(ask::kPoint, old);
  two.run(50);
  assert_int_equal(two.a.status[stale], static_cast<int>(Status::kEpochVoid));
  assert_true(two.bench.generator.reference().standing());
  assert_true(two.a.epoch > before);
  present.message(1, RawMessage().number(1, two.a.epoch).number(2, 5));
  const std::uint32_t taken = two.a.send(ask::kPoint, present);
  const std::uint32_t twice = two.a.send(ask::kPoint, present);
  two.run(2);
  assert_int_equal(two.a.status[taken], 0);
  assert_int_equal(two.a.status[twice], static_cast<int>(Status::kEpochVoid));
}

// Proves GW-17.

void what_does_not_belong_to_this_robot_is_refused_by_name(void**) {
  constexpr auto kJoints = static_cast<std::size_t>(kDof);
  TwoClients& two = fresh_clients();
  two.a.lease(0, 60000);
  two.run(1);
  const JointVector q = ServerBench::home().q;
  const JointVector rates = JointVector::Zero();
  const double zeros[7] = {}, time_s = 0.1;
  RawMessage beyond, chunk;
  beyond.number(1, 1U << kDof);
  chunk.number(3, 1).reals(9, &time_s, 1).reals(10, q.data(), kJoints);
  const auto refused = [&two](std::uint32_t kind, const RawMessage& body, const char* why,
                              Status status) {
    const std::uint32_t number = two.a.send(kind, body);
    two.run(1);
    assert_int_equal(two.a.status[number], static_cast<int>(status));
    assert_non_null(std::strstr(two.a.text, why));
  };
  const char* const kBits = "Terms.held_joints has bits beyond the 7 joints";
  const Status bad = Status::kBadValue;
  const RawMessage point = RawMessage().message(3, RawMessage().reals(1, q.data(), kJoints));
  const RawMessage velocity = RawMessage().number(3, 50).reals(4, rates.data(), kJoints);
  refused(ask::kPoint, RawMessage(point).message(2, beyond), kBits, bad);
  refused(ask::kVelocity, RawMessage(velocity).message(2, beyond), kBits, bad);
  refused(ask::kChunk, RawMessage(chunk).message(2, beyond), kBits, bad);
  refused(ask::kBegin, RawMessage().message(1, beyond), kBits, bad);
  refused(ask::kVelocity, RawMessage(velocity).reals(5, zeros, 6), "leave pose and twist empty",
          bad);
  refused(ask::kChunk, RawMessage(chunk).reals(12, zeros, 7), "leave pose and twist empty", bad);
  const RawMessage frame = RawMessage().text(2, "nix.nix"), wrench = RawMessage().text(3, "tcp.x");
  refused(ask::kPoint, RawMessage(point).message(2, frame), "(11)", Status::kNotOffered);
  refused(ask::kVelocity, RawMessage(velocity).message(2, frame), "(11)", Status::kNotOffered);
  refused(ask::kChunk, RawMessage(chunk).message(2, wrench), "(11)", Status::kNotOffered);
  refused(ask::kBegin, RawMessage().message(1, frame), "(11)", Status::kNotOffered);
  for (const double fade_s : {-1e-9, 0.3001, double{NAN}})
    refused(ask::kChunk, RawMessage(chunk).real(8, fade_s), "Chunk.crossfade_s", bad);
  JointVector unknown = rates;
  unknown[2] = NAN;
  refused(ask::kVelocity, RawMessage().number(3, 50).reals(4, unknown.data(), kJoints), "joint 3",
          Status::kReferenceNotFinite);
  RawMessage future(chunk);
  future.number(6, 1).time(5, two.bench.now_ns + 50'000'000);
  refused(ask::kChunk, future, "observed_ns is in the future", Status::kStampRange);
  const std::uint32_t good = two.a.send(ask::kChunk, chunk);
  two.run(1);
  assert_int_equal(two.a.status[good], 0);
}

void a_velocity_that_is_not_renewed_comes_to_rest_and_is_told(void**) {
  TwoClients& two = fresh_clients();
  two.a.lease(0, 5000);
  JointVector dq = JointVector::Zero();
  dq[0] = 0.3;
  const std::uint32_t sent =
      two.a.send(ask::kVelocity,
                 RawMessage().number(3, 50).reals(4, dq.data(), static_cast<std::size_t>(kDof)));
  two.run(40);
  assert_int_equal(two.a.outcome[sent], 14);  // EXECUTED
  assert_int_equal(two.a.starved, 0);
  two.run(500);
  assert_int_equal(two.a.starved, 1);
  assert_int_equal(two.a.finals[sent], 1);
  assert_true(two.bench.generator.reference().standing());
}

// Proves GW-3.

void a_flood_of_rearms_leaves_places_for_stops(void**) {
  TwoClients& two = fresh_clients();
  two.a.lease();
  two.run(1);
  for (int i = 0; i < 40; ++i) two.a.send(ask::kRearm);
  two.bench.server.work(two.bench.now_ns);
  const std::uint32_t stop = two.b.send(ask::kStop);
  two.run(40);
  assert_int_equal(two.b.status[stop], 0);
  assert_int_equal(two.b.finals[stop], 1);
}

// Proves GW-7.

void datagrams_move_the_arm_of_their_session_only(void**) {
  TwoClients& two = fresh_clients();
  two.a.lease();
  two.run(1);
  JointVector q = ServerBench::home().q;
  q[0] += 0.1;
  RawMessage body;
  body.message(3, RawMessage().reals(1, q.data(), static_cast<std::size_t>(kDof)));
  for (const std::uint64_t session : {std::uint64_t{0}, two.a.session + 77, two.b.session}) {
    RawMessage forged;
    forged.number(1, 9).fixed64(4, session).message(ask::kPoint, body);
    two.bench.server.datagram({forged.bytes.data(), forged.size}, two.bench.now_ns);
    two.run(10);
    assert_true(two.bench.generator.reference().standing());
  }
  RawMessage stop;
  stop.number(1, 9).fixed64(4, two.a.session).message(ask::kStop, {});
  two.bench.server.datagram({stop.bytes.data(), stop.size}, two.bench.now_ns);
  two.run(3);
  assert_true(two.bench.rung == Rung::kNominal);
  RawMessage own;
  own.number(1, 9).fixed64(4, two.a.session).message(ask::kPoint, body);
  two.bench.server.datagram({own.bytes.data(), own.size}, two.bench.now_ns);
  two.run(3000);
  ASSERT_NEAR(two.bench.generator.reference().q[0], q[0], 1e-9);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_flood_of_rearms_leaves_places_for_stops),
      cmocka_unit_test(a_point_moves_the_reference_in_the_next_cycle),
      cmocka_unit_test(points_with_stamps_are_followed_evenly),
      cmocka_unit_test(what_a_stop_voids_does_not_move_the_arm),
      cmocka_unit_test(what_does_not_belong_to_this_robot_is_refused_by_name),
      cmocka_unit_test(a_velocity_that_is_not_renewed_comes_to_rest_and_is_told),
      cmocka_unit_test(datagrams_move_the_arm_of_their_session_only),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
