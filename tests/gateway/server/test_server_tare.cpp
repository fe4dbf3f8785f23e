// Tests tares that clients ask for: the server, the cycle's end of the mailboxes, the executive and
// a pipeline with a front end, in virtual time.
#include "tests/gateway/server/cycle_bench.hpp"
#include "tests/support/fresh.hpp"

namespace tactus {
namespace {

constexpr std::string_view kSensor =
    "[model]\ntype = robot_model\nq = robot.q\ndq = robot.dq\n"
    "[sensor]\ntype = wrench_front_end\nft = robot.ft\nx = model.x\ntool = robot.tool\n"
    "max_force = 300\nmax_moment = 30\ntare_s = 0.05\ntare_timeout_s = 0.2\n";
constexpr int kExecuted = 14, kRefusedOutcome = 16;  // of Report

/// A cycle with clients A, who has the lease, and B, who hears of events.
struct Bench {
  CycleBench cycles;
  TestClient a, b;
  Random random{5};
  bool shakes = false;

  void start(std::string_view blocks = kSensor) {
    cycles.hal.state.ft = zero();
    cycles.start(blocks);
    cycles.welcome(a, "A");
    cycles.welcome(b, "B");
    a.lease(0, 60000);
    b.send(ask::kSubscribe, RawMessage().number(3, 1));
    run(100);
  }
  static Vector6 zero() {
    Vector6 zero;
    zero << 1.0, -2.0, 3.0, 0.1, 0.2, -0.3;
    return zero;
  }
  void run(int count) {
    for (int i = 0; i < count; ++i) {
      if (shakes) cycles.hal.state.ft[0] = random.uniform(-9.0, 9.0);
      cycles.cycle();
      cycles.server->work(cycles.now_ns);
      a.read();
      b.read();
    }
  }
  const WrenchFrontEnd& front() const {
    return *static_cast<const WrenchFrontEnd*>(cycles.pipeline[2].place);
  }
  Rung rung() const { return cycles.executive.rung(); }
};
Status answered(const TestClient& client, std::uint32_t number) {
  assert_int_equal(client.answers[number], 1);
  return static_cast<Status>(client.status[number]);
}
/// Asserts that a tare was taken, and its one final Report.
void assert_report(const TestClient& client, std::uint32_t number, int outcome, Status status) {
  ASSERT_OK(answered(client, number));
  assert_int_equal(client.finals[number], 1);
  assert_int_equal(client.outcome[number], outcome);
  ASSERT_STATUS(static_cast<Status>(client.refusals[number]), status);
}

// Proves GW-21.

void a_tare_is_reported_with_its_zero_when_that_holds_and_everybody_is_told(void**) {
  Bench& bench = fresh<Bench>();
  assert_true((bench.front().bias.value - Bench::zero()).norm() < 1e-12);
  bench.cycles.hal.state.ft[0] += 4.0;
  const std::uint32_t number = bench.a.send(ask::kTare);
  bench.run(45);
  ASSERT_OK(answered(bench.a, number));
  assert_int_equal(bench.a.finals[number], 0);
  assert_true((bench.front().bias.value - Bench::zero()).norm() < 1e-12);
  bench.run(10);
  assert_report(bench.a, number, kExecuted, Status::kOk);
  assert_string_equal(bench.a.text,
                      "[sensor] the zero moved by 4 N, 0 N m, to 5 -2 3 N, 0.1 0.2 -0.3 N m");
  assert_string_equal(bench.b.event,
                      "[sensor] the zero moved by 4 N, 0 N m, to 5 -2 3 N, 0.1 0.2 -0.3 N m, by A");
  assert_int_equal(bench.a.zeros, 6);
  ASSERT_NEAR(bench.a.zero[0], 5.0, 1e-12);
  ASSERT_NEAR(bench.a.zero[5], -0.3, 1e-12);
}

void what_may_be_a_contact_is_refused_with_the_figures(void**) {
  Bench& bench = fresh<Bench>();
  bench.cycles.hal.state.ft[2] += 12.0;
  const std::uint32_t number = bench.a.send(ask::kTare);
  bench.run(60);
  assert_report(bench.a, number, kRefusedOutcome, Status::kTareLimit);
  assert_non_null(std::strstr(
      bench.a.text, "[sensor] the zero would move by 12 N, more than max_tare_force, 5 N"));
  assert_int_equal(bench.a.zeros, 0);
  bench.cycles.hal.state.ft = Bench::zero();
  bench.cycles.hal.state.ft[4] += 1.5;
  const std::uint32_t twist = bench.a.send(ask::kTare);
  bench.run(60);
  assert_report(bench.a, twist, kRefusedOutcome, Status::kTareLimit);
  assert_non_null(
      std::strstr(bench.a.text, "would move by 1.5 N m, more than max_tare_moment, 0.5 N m"));
  assert_true((bench.front().bias.value - Bench::zero()).norm() < 1e-12);
}

void a_sensor_that_is_shaken_is_refused_and_the_arm_goes_on(void**) {
  Bench& bench = fresh<Bench>();
  bench.shakes = true;
  const std::uint32_t number = bench.a.send(ask::kTare);
  bench.run(210);
  assert_report(bench.a, number, kRefusedOutcome, Status::kSensorNotSteady);
  assert_true(bench.rung() == Rung::kNominal);
}

void only_the_owner_tares_and_one_tare_is_under_way(void**) {
  Bench& bench = fresh<Bench>();
  const std::uint32_t other = bench.b.send(ask::kTare), first = bench.a.send(ask::kTare);
  bench.run(10);
  const std::uint32_t second = bench.a.send(ask::kTare);
  bench.run(100);
  ASSERT_STATUS(answered(bench.b, other), Status::kNotOwner);
  assert_report(bench.a, first, kExecuted, Status::kOk);
  ASSERT_STATUS(answered(bench.a, second), Status::kMailboxFull);
  assert_int_equal(bench.b.finals[other] + bench.a.finals[second], 0);
  const std::uint32_t third = bench.a.send(ask::kTare);
  bench.run(100);
  assert_report(bench.a, third, kExecuted, Status::kOk);
}

void without_a_front_end_or_its_tare_it_is_refused_by_name(void**) {
  Bench& none = fresh<Bench>("");
  const std::uint32_t number = none.a.send(ask::kTare);
  none.run(5);
  ASSERT_STATUS(answered(none.a, number), Status::kNotOffered);
  assert_non_null(std::strstr(none.a.text, "no wrench_front_end"));
  assert_false(none.a.offers_tare);
  Bench& untared = fresh<Bench>();
  assert_true(untared.a.offers_tare);
  const_cast<WrenchFrontEnd&>(untared.front()).params.tare_s = 0.0;
  const std::uint32_t later = untared.a.send(ask::kTare);
  untared.run(5);
  ASSERT_STATUS(answered(untared.a, later), Status::kNotOffered);
  assert_non_null(std::strstr(untared.a.text, "[sensor] tare_s is 0"));
  assert_int_equal(untared.a.finals[later], 0);
}

/// On every rung below skip_optional, and at every moment of a tare.
void a_stop_ends_a_tare_and_a_stopped_arm_takes_none(void**) {
  for (int moment = 0; moment < 60; moment += 3) {
    Bench& bench = fresh<Bench>();
    bench.cycles.hal.state.ft[0] += 4.0;
    const std::uint32_t tare = bench.a.send(ask::kTare);
    bench.run(moment);
    const std::uint32_t stop = bench.b.send(ask::kStop);
    bench.run(5);
    const std::uint32_t late = bench.a.send(ask::kTare);
    bench.run(5);
    assert_int_equal(bench.b.finals[stop], 1);
    const bool over = bench.a.outcome[tare] == kExecuted;
    if (moment < 48 || moment > 51) assert_int_equal(over, moment > 51);
    assert_report(bench.a, tare, over ? kExecuted : kRefusedOutcome,
                  over ? Status::kOk : Status::kHalted);
    assert_int_equal((bench.front().bias.value - Bench::zero()).norm() > 1.0, over);
    assert_report(bench.a, late, kRefusedOutcome, Status::kHalted);
    assert_non_null(std::strstr(bench.a.text, "Rearm takes a new zero"));
  }
}

// Proves GW-2.

/// Two clients in a random order of tares, stops, rearms, takeovers and shaken sensors.
void whatever_the_order_every_tare_is_answered_and_reported_once(void**) {
  int count[256] = {};
  Bench& bench = fresh<Bench>();
  for (int k = 0; k < 6000; ++k) {
    TestClient& client = bench.random.below(2) == 0 ? bench.a : bench.b;
    const int what = bench.random.below(12);
    if (what < 5) client.send(ask::kTare);
    if (what == 5 && bench.random.below(4) == 0) client.send(ask::kStop);
    if (what == 6) client.send(ask::kRearm);
    if (what == 7) client.lease(static_cast<unsigned>(bench.random.below(3)), 60000);
    if (what == 8) bench.shakes = bench.random.below(3) == 0;
    if (what == 9) bench.cycles.hal.state.ft = bench.random.uniform(0.0, 2.0) * Bench::zero();
    bench.run(bench.random.below(30));
  }
  bench.shakes = false;
  bench.run(1000);
  for (const TestClient* client : {&bench.a, &bench.b})
    for (std::uint32_t n = 1; n <= client->number; ++n) {
      if (client->kinds[n] != ask::kTare) continue;
      const bool taken = answered(*client, n) == Status::kOk;
      assert_int_equal(client->finals[n], taken);
      if (taken) ++count[client->refusals[n]];
    }
  for (const Status seen : {Status::kOk, Status::kSensorNotSteady, Status::kHalted})
    assert_true(count[static_cast<int>(seen)] > 5);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_tare_is_reported_with_its_zero_when_that_holds_and_everybody_is_told),
      cmocka_unit_test(what_may_be_a_contact_is_refused_with_the_figures),
      cmocka_unit_test(a_sensor_that_is_shaken_is_refused_and_the_arm_goes_on),
      cmocka_unit_test(only_the_owner_tares_and_one_tare_is_under_way),
      cmocka_unit_test(without_a_front_end_or_its_tare_it_is_refused_by_name),
      cmocka_unit_test(a_stop_ends_a_tare_and_a_stopped_arm_takes_none),
      cmocka_unit_test(whatever_the_order_every_tare_is_answered_and_reported_once),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
