// Tests in virtual time how soon a message changes the command: one that the server has before a
// cycle begins counts in that cycle, and the drives get another command in it or in the next.
#include "tests/gateway/server/cycle_bench.hpp"
#include "tests/support/fresh.hpp"

namespace tactus {
namespace {

struct Bench {
  CycleBench cycles;
  TestClient client;

  /// A client that owns the arm, which has been at rest for a while.
  void start() {
    cycles.start();
    cycles.welcome(client, "A");
    client.lease(0, 60000);
    run(20);
  }
  void run(int count) {
    for (int i = 0; i < count; ++i) {
      cycles.cycle();
      cycles.server->work(cycles.now_ns);
      client.read();
    }
  }
  const JointVector& command() const { return cycles.hal.command.value; }
  /// The server takes what was sent; returns the number of the first cycle after that with another
  /// command than `expected` says, from 1; 0: none of three.
  template <class Expected>
  int first_changed(Expected expected) {
    cycles.server->work(cycles.now_ns);
    for (int k = 1; k <= 3; ++k) {
      const JointVector without = expected();
      cycles.cycle();
      if (command() != without) return k;
    }
    return 0;
  }
  int first_moved() {
    return first_changed([this] { return command(); });
  }
};

// Proves GW-13.

void a_point_a_velocity_a_chunk_and_a_trajectory_move_the_arm_within_two_cycles(void**) {
  JointVector far = ServerBench::home().q, rates = JointVector::Zero();
  far[0] += 0.1;
  rates[0] = 0.1;
  constexpr auto kJoints = static_cast<std::size_t>(kDof);
  const double now_s = 0.0, later_s = 2.0;
  for (int kind = 0; kind < 4; ++kind) {
    Bench& bench = fresh<Bench>();
    if (kind == 0) bench.client.point(far);
    if (kind == 1)
      bench.client.send(ask::kVelocity,
                        RawMessage().number(3, 100).reals(4, rates.data(), kJoints));
    if (kind == 2) {
      const double times[] = {now_s, 0.3, 0.6};
      std::array<double, 3 * kJoints> targets;
      for (std::size_t i = 0; i < targets.size(); ++i)
        targets[i] = ServerBench::home().q[static_cast<int>(i % kJoints)];
      targets[kJoints] += 0.02;
      targets[2 * kJoints] += 0.04;
      bench.client.send(
          ask::kChunk,
          RawMessage().number(3, 1).reals(9, times, 3).reals(10, targets.data(), targets.size()));
    }
    if (kind == 3) {
      bench.client.send(ask::kBegin, RawMessage().number(2, 3));
      bench.cycles.server->work(bench.cycles.now_ns);  // grants credit
      bench.client.send(ask::kPart,
                        RawMessage().reals(1, &later_s, 1).reals(2, far.data(), kJoints));
      bench.client.send(ask::kEnd);
    }
    const int first = bench.first_moved();
    assert_true(first == 1 || first == 2);
  }
}

void a_pause_a_cancel_and_a_stop_slow_the_arm_down_within_two_cycles(void**) {
  JointVector far = ServerBench::home().q;
  far[0] += 0.5;
  for (const std::uint32_t kind : {ask::kPause, ask::kCancel, ask::kOverride, ask::kStop}) {
    const double whole_s = 4.0;
    static Bench untouched;  // the same motion without the message
    static Bench* twin = nullptr;
    Bench& bench = fresh<Bench>();
    twin = &untouched;
    new (twin) Bench;
    twin->start();
    for (Bench* each : {&bench, twin}) {
      each->client.send(ask::kBegin, RawMessage().number(2, 3));
      each->run(1);
      each->client.send(
          ask::kPart,
          RawMessage().reals(1, &whole_s, 1).reals(2, far.data(), static_cast<std::size_t>(kDof)));
      each->client.send(ask::kEnd);
      each->run(1500);
    }
    assert_true(bench.command() == twin->command());
    bench.client.send(kind, RawMessage().real(1, 0.5));
    const int first = bench.first_changed([] {
      twin->cycles.cycle();
      return twin->command();
    });
    assert_true(first == 1 || first == 2);
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_point_a_velocity_a_chunk_and_a_trajectory_move_the_arm_within_two_cycles),
      cmocka_unit_test(a_pause_a_cancel_and_a_stop_slow_the_arm_down_within_two_cycles),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
