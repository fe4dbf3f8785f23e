// Tests the connections of the server: greeting, answers, and the clients that it cuts.
#include "tests/gateway/server/client_bench.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

/// Runs cycles in which B says something often enough.
void wait(TwoClients& two, int ms) {
  for (int i = 0; i < ms; i += 1000) {
    two.run(1000);
    two.b.send(ask::kPing);
  }
}

// Proves GW-1.

void the_first_message_is_hello_and_is_answered_by_a_welcome(void**) {
  TwoClients& two = fresh_clients();
  two.a.close();
  two.a.connect(two.bench);
  const std::uint32_t early = two.a.send(ask::kPing);
  const std::uint32_t old =
      two.a.send(ask::kHello, RawMessage().number(1, 7).text(2, "from tomorrow"));
  const std::uint32_t hello = two.a.send(ask::kHello, RawMessage().number(1, 1).text(2, "A"));
  const std::uint32_t again = two.a.send(ask::kHello, RawMessage().number(1, 1).text(2, "A"));
  two.run(1);
  assert_int_equal(two.a.status[early], static_cast<int>(Status::kNotStarted));
  assert_int_equal(two.a.status[old], static_cast<int>(Status::kBadValue));
  assert_int_equal(two.a.welcomes, 1);
  assert_int_equal(two.a.answers[hello], 1);
  assert_int_equal(two.a.status[again], static_cast<int>(Status::kDuplicate));
}

void a_message_may_come_byte_by_byte(void**) {
  TwoClients& two = fresh_clients();
  RawMessage whole;
  whole.number(1, 50).message(ask::kPing, {});
  std::uint8_t length[4] = {static_cast<std::uint8_t>(whole.size), 0, 0, 0};
  for (const std::uint8_t& byte : length) {
    two.a.push(&byte, 1);
    two.run(1);
  }
  for (std::size_t i = 0; i < whole.size; ++i) {
    assert_int_equal(two.a.answers[50], 0);
    two.a.push(whole.bytes.data() + i, 1);
    two.run(1);
  }
  assert_int_equal(two.a.answers[50], 1);
}

void unknown_fields_are_ignored_and_unknown_requirements_refused(void**) {
  TwoClients& two = fresh_clients();
  RawMessage ignored;
  ignored.number(1, 40).text(99, "from a later version").message(ask::kPing, {});
  two.a.send_bytes(ignored);
  RawMessage required;
  const std::uint8_t feature[1] = {60};
  required.number(1, 41).block(3, feature, 1).message(ask::kStop, {});
  two.a.send_bytes(required);
  RawMessage unknown;
  unknown.number(1, 42).message(77, {});
  two.a.send_bytes(unknown);
  two.run(2);
  assert_int_equal(two.a.answers[40], 1);
  assert_int_equal(two.a.status[40], 0);
  assert_int_equal(two.a.status[41], static_cast<int>(Status::kNotOffered));
  assert_true(two.bench.rung == Rung::kNominal);
  assert_int_equal(two.a.answers[42], 1);
  assert_int_equal(two.a.status[42], static_cast<int>(Status::kUnknownKey));
}

// Proves GW-5.

void a_flood_is_cut_and_the_others_are_told(void**) {
  TwoClients& two = fresh_clients();
  two.b.send(ask::kSubscribe, RawMessage().number(3, 1));
  two.run(1);
  for (int i = 0; i < kMessageBurst + 2 && two.a.final_status == 0; ++i) {
    two.a.send(ask::kPing);
    two.bench.server.work(two.bench.now_ns);
    two.a.read();
  }
  two.run(1);
  assert_int_equal(two.a.final_status, static_cast<int>(Status::kTooManyMessages));
  assert_true(two.a.finished());
  assert_non_null(std::strstr(two.b.event, "A is cut: more than 5000 messages in a second"));
  assert_string_equal(last_log, two.b.event);
}

void a_client_that_reads_nothing_is_cut_and_bounded_until_then(void**) {
  TwoClients& two = fresh_clients();
  two.a.send(ask::kSubscribe, RawMessage().number(1, 1).number(2, 1).number(3, 1));
  two.a.reads = false;
  two.run(1500);
  assert_true(two.bench.server.waiting(two.a.slot).size <= kOutputBytes - kReserveBytes + 4096);
  assert_false(two.a.finished());
  two.run(1000);
  assert_int_equal(two.bench.server.space(two.a.slot).size, 0);
  two.run(1100);
  assert_true(two.a.finished());
  two.a.read();
  assert_int_equal(two.a.final_status, static_cast<int>(Status::kClientSlow));
}

void a_silent_client_is_cut_after_fifteen_seconds(void**) {
  TwoClients& two = fresh_clients();
  wait(two, 14'000);
  assert_int_equal(two.a.final_status, 0);
  wait(two, 2'000);
  assert_int_equal(two.a.final_status, static_cast<int>(Status::kClientSilent));
  assert_true(two.a.finished());
  assert_int_equal(two.b.final_status, 0);
}

void who_does_not_say_hello_is_cut_after_five_seconds(void**) {
  TwoClients& two = fresh_clients();
  two.a.close();
  two.a.connect(two.bench);
  wait(two, 4'000);
  assert_int_equal(two.a.final_status, 0);
  wait(two, 2'000);
  assert_int_equal(two.a.final_status, static_cast<int>(Status::kClientSilent));
}

void bytes_that_are_no_message_cut_their_client_and_no_other(void**) {
  const std::uint8_t long_one[4] = {1, 64, 0, 0};  // 16 KiB and one byte
  const std::uint8_t garbage[] = {3, 0, 0, 0, 0xff, 0xff, 0xff};
  const std::uint8_t broken[] = {3, 0, 0, 0, 0x52, 0x30, 0x01};  // a Hello longer than its frame
  const Bytes cases[] = {{long_one, 4}, {garbage, 7}, {broken, 7}};
  for (const Bytes& bytes : cases) {
    TwoClients& two = fresh_clients();
    two.a.push(bytes.data, bytes.size);
    two.run(1);
    assert_int_equal(two.a.final_status, static_cast<int>(Status::kBadValue));
    const std::uint32_t ping = two.b.send(ask::kPing);
    two.run(1);
    assert_int_equal(two.b.answers[ping], 1);
    assert_true(two.a.finished());
    two.a.close();
    two.a.greet("A again");
    two.run(1);
    assert_int_equal(two.a.welcomes, 1);
  }
}

void there_are_no_more_clients_than_slots(void**) {
  TwoClients& two = fresh_clients();
  for (int i = 2; i < kMostClients; ++i)
    assert_int_equal(two.bench.server.open(1000 + static_cast<std::uint64_t>(i), 0), i);
  assert_int_equal(two.bench.server.open(99, 0), -1);
}

RawFields fields_of(const Bytes& message) {
  return {message.data, message.data + message.size};
}

// Proves GW-19.

/// A, who owns the motion, and B, who watches, stay; the others send nothing but Pings.
void whoever_is_idle_gives_way_where_all_places_are_taken(void**) {
  TwoClients& two = fresh_clients();
  std::array<TestClient, kMostClients - 2> others;
  for (TestClient& other : others) {
    other.connect(two.bench);
    other.hello(&other == &others[0] ? "first" : "other");
  }
  two.a.lease(0, 60000);
  two.b.send(ask::kSubscribe, RawMessage().number(1, 1000));
  two.run(1);
  TestClient newest;
  newest.connect(two.bench);
  assert_int_equal(newest.slot, -1);
  newest.take(fields_of(two.bench.server.refuse_connection(two.bench.now_ns)));
  assert_int_equal(newest.final_status, static_cast<int>(Status::kTooLarge));
  assert_string_equal(newest.text,
                      "all places are taken; end one of these, or try again: A, B, first, other, "
                      "other, other, other, other");
  for (int s = 0; s < 62; ++s) {
    two.bench.now_ns += kSecond_ns;
    for (TestClient& other : others) other.send(ask::kPing);
    two.a.send(ask::kPing);
    two.b.send(ask::kPing);
    if (s == 10)
      for (std::size_t i = 1; i < others.size(); ++i) others[i].send(ask::kCancel);
    two.run(2);
    for (TestClient& other : others) other.read();
  }
  newest.take(fields_of(two.bench.server.refuse_connection(two.bench.now_ns)));
  assert_non_null(std::strstr(newest.text, "first is idle and gives way: connect again"));
  others[0].read();
  assert_non_null(std::strstr(others[0].text, "idle for a minute while all places are taken"));
  assert_true(others[0].finished());
  others[0].close();
  newest.greet("newest");
  two.run(1);
  newest.read();
  assert_int_equal(newest.welcomes, 1);
  for (std::size_t i = 1; i < others.size(); ++i) assert_false(others[i].finished());
}

// Proves GW-5.

void names_for_people_are_printable(void**) {
  TwoClients& two = fresh_clients();
  two.a.close();
  two.a.greet("\x1b[31mred\n");
  two.run(1);
  assert_string_equal(last_log, "?[31mred? has joined");
}

/// Client A hears of events, among them that the cycle has stopped the arm as `told` says.
TwoClients& stopped_clients(CycleSnapshot told) {
  TwoClients& two = fresh_clients();
  two.a.send(ask::kSubscribe, RawMessage().number(3, 1));
  two.run(2);
  told.stamp_ns = two.bench.now_ns;
  told.rung = static_cast<std::uint8_t>(two.bench.rung = Rung::kStop);
  assert_true(two.bench.mailboxes.snapshots.post(told));
  two.run(1);
  return two;
}

void a_collision_is_an_event_that_says_with_what(void**) {
  CycleSnapshot told;
  told.status = Status::kCollision;
  told.fault = told.status;
  told.first = "hand";
  told.second = "wall";
  TwoClients& two = stopped_clients(told);
  assert_string_equal(two.a.event, "stop: collision (77): hand with wall");
}

void a_fault_of_a_joint_is_an_event_with_joint_value_and_limit(void**) {
  CycleSnapshot told;
  told.status = Status::kPathTolerance;
  told.fault = FaultVerdict({told.status, -1, 3, 0.25, 0.125});
  TwoClients& two = stopped_clients(told);
  const Line said = Line("stop: joint 4 (")
                    << Robot::kJointNames[3] << "): path error 0.25 rad exceeds 0.125 rad (49)";
  assert_string_equal(two.a.event, said.c_str());
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_fault_of_a_joint_is_an_event_with_joint_value_and_limit),
      cmocka_unit_test(the_first_message_is_hello_and_is_answered_by_a_welcome),
      cmocka_unit_test(a_message_may_come_byte_by_byte),
      cmocka_unit_test(unknown_fields_are_ignored_and_unknown_requirements_refused),
      cmocka_unit_test(a_flood_is_cut_and_the_others_are_told),
      cmocka_unit_test(a_client_that_reads_nothing_is_cut_and_bounded_until_then),
      cmocka_unit_test(a_silent_client_is_cut_after_fifteen_seconds),
      cmocka_unit_test(who_does_not_say_hello_is_cut_after_five_seconds),
      cmocka_unit_test(bytes_that_are_no_message_cut_their_client_and_no_other),
      cmocka_unit_test(there_are_no_more_clients_than_slots),
      cmocka_unit_test(whoever_is_idle_gives_way_where_all_places_are_taken),
      cmocka_unit_test(names_for_people_are_printable),
      cmocka_unit_test(a_collision_is_an_event_that_says_with_what),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
