// Tests parameters over the connection: the lease, one report of each set, events, pages, floods.
#include <string>

#include "tests/gateway/server/client_bench.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

RawMessage set_of(std::string_view section, std::string_view key, std::string_view value) {
  return RawMessage().message(2, RawMessage().text(1, section).text(2, key).text(3, value));
}
RawMessage kp(std::string_view value) {
  return set_of("pd", "kp", value);
}
const JointVector& kp_of(TwoClients& two) {
  return static_cast<const PdGravity*>(two.bench.pipeline[0].place)->params.kp;
}
Status status(const TestClient& client, std::uint32_t number) {
  return static_cast<Status>(client.status[number]);
}

/// Client A has the lease, B hears of events.
TwoClients& owned() {
  TwoClients& two = fresh_clients();
  two.a.lease(0, 60'000);
  two.b.send(ask::kSubscribe, RawMessage().number(3, 1));
  two.run(2);
  return two;
}

// Proves PAR-6.

void only_the_owner_changes_parameters_and_everybody_may_check_and_read(void**) {
  TwoClients& two = owned();
  const std::uint32_t other = two.b.send(ask::kParameters, kp("50"));
  const std::uint32_t check = two.b.send(ask::kParameters, kp("50").number(1, 1));
  const std::uint32_t wrong = two.b.send(ask::kParameters, kp("-5").number(1, 1));
  const std::uint32_t read = two.b.send(ask::kListParameters);
  two.run(5);
  assert_true(status(two.b, other) == Status::kNotOwner);
  assert_true(status(two.b, check) == Status::kOk);
  assert_true(status(two.b, wrong) == Status::kBadValue);
  assert_true(status(two.b, read) == Status::kOk);
  for (const std::uint32_t number : {other, wrong, read}) assert_int_equal(two.b.finals[number], 0);
  assert_int_equal(two.b.finals[check], 1);
  assert_int_equal(two.b.outcome[check], 14);  // EXECUTED
  assert_true(kp_of(two)[0] == 100.0);
}

void a_set_is_reported_once_after_it_took_effect_and_everybody_is_told(void**) {
  TwoClients& two = owned();
  log_lines = 0;
  const std::uint32_t number = two.a.send(ask::kParameters, kp("50"));
  two.bench.server.work(two.bench.now_ns);
  two.a.read();
  assert_int_equal(two.a.answers[number], 1);
  assert_int_equal(two.a.finals[number], 0);
  assert_true(kp_of(two)[0] == 100.0);  // the cycle has not run yet
  two.run(20);
  assert_int_equal(two.a.finals[number], 1);
  assert_int_equal(two.a.outcome[number], 14);  // EXECUTED
  assert_true(kp_of(two)[0] == 50.0);
  assert_string_equal(two.b.event, "[pd] kp: 100 -> 50, by A");
  assert_string_equal(last_log, two.b.event);
  assert_int_equal(log_lines, 1);
}

/// Not only what stands before the zero is judged.
void a_text_that_contains_a_zero_is_refused(void**) {
  using namespace std::literals;
  TwoClients& two = owned();
  for (const RawMessage& set : {set_of("pd\0"sv, "kp", "50"), set_of("pd", "kp\0"sv, "50"),
                                set_of("pd", "kp", "50\0"sv), set_of("pd", "kp", "50\0 20"sv)}) {
    const std::uint32_t number = two.a.send(ask::kParameters, set);
    two.run(5);
    assert_true(status(two.a, number) != Status::kOk);
    assert_true(kp_of(two)[0] == 100.0);
  }
}

void a_page_tells_how_many_sets_have_taken_effect(void**) {
  TwoClients& two = owned();
  two.a.send(ask::kListParameters);
  two.run(1);
  assert_int_equal(two.a.sets, 0);
  const std::uint32_t total = two.a.total;
  assert_true(total > 20);
  for (const char* value : {"50", "60", "-1"}) {
    two.a.send(ask::kParameters, kp(value));
    two.run(3);
  }
  two.a.pages = 0;
  for (std::uint32_t first = 0; first < total; first += 3)
    two.a.send(ask::kListParameters, RawMessage().number(1, first));
  two.run(3);
  assert_int_equal(two.a.pages, (total + 2) / 3);
  assert_int_equal(two.a.sets, 2);
  const std::uint32_t beyond = two.a.send(ask::kListParameters, RawMessage().number(1, total + 1));
  two.run(1);
  assert_true(status(two.a, beyond) == Status::kBadValue);
}

// Proves PAR-7.

void a_second_set_is_refused_while_the_first_is_under_way(void**) {
  TwoClients& two = owned();
  two.bench.answers_sets = false;
  const std::uint32_t first = two.a.send(ask::kParameters, kp("50"));
  const std::uint32_t second = two.a.send(ask::kParameters, kp("60"));
  const std::uint32_t check = two.a.send(ask::kParameters, kp("60").number(1, 1));
  two.run(5);
  assert_true(status(two.a, first) == Status::kOk);
  assert_true(status(two.a, second) == Status::kMailboxFull);
  assert_true(status(two.a, check) == Status::kMailboxFull);
  assert_int_equal(two.a.finals[first], 0);
  two.bench.answers_sets = true;
  two.run(5);
  assert_int_equal(two.a.finals[first], 1);
  assert_int_equal(two.a.finals[second], 0);
  assert_true(kp_of(two)[0] == 50.0);
}

/// What the cycle refuses is reported with its reason, and is nowhere in force.
void a_set_that_the_cycle_refuses_is_reported_as_refused(void**) {
  for (const Status why : {Status::kEffortLimit, Status::kNotAtRest, Status::kArming}) {
    TwoClients& two = owned();
    two.bench.refused_by_cycle = {{why}, -1};
    if (why == Status::kEffortLimit) two.bench.refused_by_cycle = {{why, -1, 3, 120.0, 87.0}, 0};
    const std::uint32_t number = two.a.send(ask::kParameters, kp("50"));
    two.run(5);
    assert_true(status(two.a, number) == Status::kOk);
    assert_int_equal(two.a.finals[number], 1);
    assert_int_equal(two.a.outcome[number], 16);  // REFUSED
    assert_true(std::strlen(two.a.text) > 20);
    if (why == Status::kEffortLimit)
      assert_non_null(
          std::strstr(two.a.text, "joint 4 (fer_joint4): effort 120 N m exceeds 87 N m (38)"));
    two.bench.refused_by_cycle = {};
    two.a.send(ask::kParameters, set_of("pd", "kd", "20"));
    two.run(5);
    assert_true(kp_of(two)[0] == 100.0);
    assert_string_equal(two.b.event, "[pd] kd: 10 -> 20, by A");
  }
}

void a_flood_of_sets_loses_none_silently(void**) {
  TwoClients& two = owned();
  int taken = 0;
  std::uint32_t last = 0;
  for (int i = 0; i < 1000; ++i) {
    for (int k = 0; k < 4; ++k)
      last = two.a.send(ask::kParameters, kp(std::to_string(1 + (4 * i + k) % 90)));
    two.run(1);
  }
  two.run(5);
  for (std::uint32_t n = 1; n <= last; ++n) {
    if (two.a.kinds[n] != ask::kParameters) continue;
    assert_int_equal(two.a.answers[n], 1);
    const bool good = status(two.a, n) == Status::kOk;
    assert_true(good || status(two.a, n) == Status::kMailboxFull);
    assert_int_equal(two.a.finals[n], good);
    taken += good;
  }
  assert_true(taken >= 900);
}

void an_owner_that_dies_with_a_set_under_way_leaves_a_server_that_takes_others(void**) {
  TwoClients& two = owned();
  two.bench.answers_sets = false;
  two.a.send(ask::kParameters, kp("50"));
  two.bench.server.work(two.bench.now_ns);
  two.a.close();
  two.run(5);
  two.bench.answers_sets = true;
  two.run(5);
  two.b.lease();
  const std::uint32_t number = two.b.send(ask::kParameters, kp("70"));
  two.run(5);
  assert_int_equal(two.b.finals[number], 1);
  assert_true(kp_of(two)[0] == 70.0);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(only_the_owner_changes_parameters_and_everybody_may_check_and_read),
      cmocka_unit_test(a_set_is_reported_once_after_it_took_effect_and_everybody_is_told),
      cmocka_unit_test(a_text_that_contains_a_zero_is_refused),
      cmocka_unit_test(a_page_tells_how_many_sets_have_taken_effect),
      cmocka_unit_test(a_second_set_is_refused_while_the_first_is_under_way),
      cmocka_unit_test(a_set_that_the_cycle_refuses_is_reported_as_refused),
      cmocka_unit_test(a_flood_of_sets_loses_none_silently),
      cmocka_unit_test(an_owner_that_dies_with_a_set_under_way_leaves_a_server_that_takes_others),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
