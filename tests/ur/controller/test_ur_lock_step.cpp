// Tests when the emulated controller may begin its next cycle early: sessions in memory, cycles by
// hand.
#include "tests/ur/controller/ur_rtde_client.hpp"

namespace tactus::ur {
namespace {

/// Opens a client that receives packets and writes a register.
void close_loop() {
  connect_rtde();
  send_packet('I', "input_int_register_24", g_client);
  g_bench.send(g_client, session_stream());
  g_bench.take(g_client);
}
void answer() {
  send_packet('U', bytes("01 00 00 00 07"), g_client);
}
void tick() {
  g_bench.ticks(1);
  g_bench.take(g_client);
}
/// Answers packets until the controller relies on the client's answers.
void make_steady() {
  for (int i = 0; i < 30; ++i) {
    tick();
    answer();
  }
}
void assert_pace(Pace expected) {
  assert_int_equal(static_cast<int>(g_bench->pace()), static_cast<int>(expected));
}

// Proves URE-50.

void an_answer_lets_the_next_cycle_begin(void**) {
  close_loop();
  for (int i = 0; i < 5; ++i) {
    tick();
    assert_pace(Pace::kByTime);  // the client is not known yet
    answer();
    assert_pace(Pace::kAtOnce);
  }
}

void without_a_client_that_closes_a_loop_cycles_keep_their_time(void**) {
  connect_rtde();
  assert_pace(Pace::kByTime);
  g_bench.send(g_client, session_stream());  // only listens
  tick();
  assert_pace(Pace::kByTime);
  const int writer = g_bench->open(Service::kRtde);  // writes once, and receives nothing
  send_packet('I', "input_int_register_24", writer);
  send_packet('U', bytes("01 00 00 00 07"), writer);
  assert_pace(Pace::kByTime);
}

void a_client_that_always_answered_is_waited_for(void**) {
  close_loop();
  make_steady();
  tick();
  assert_pace(Pace::kWaits);
  tick();  // the wait is over
  tick();
  assert_pace(Pace::kByTime);
  answer();  // answers the last packet only
  assert_pace(Pace::kAtOnce);
}

void a_set_point_that_did_not_wait_for_its_packet_counts_for_it(void**) {
  close_loop();
  make_steady();
  answer();
  answer();
  tick();
  assert_pace(Pace::kAtOnce);
  tick();
  assert_pace(Pace::kAtOnce);
  tick();
  assert_pace(Pace::kWaits);
}

void a_client_is_no_more_than_some_cycles_ahead(void**) {
  close_loop();
  for (int i = 0; i < 1000; ++i) answer();
  int ahead = 0;
  for (; ahead < 100 && g_bench->pace() == Pace::kAtOnce; ++ahead) tick();
  assert_in_range(ahead, 6, 20);
}

void all_that_close_a_loop_must_have_answered(void**) {
  close_loop();
  const int other = g_bench->open(Service::kRtde);
  send_packet('I', "input_int_register_25", other);
  g_bench.send(other, session_stream());
  tick();
  answer();
  assert_pace(Pace::kByTime);
  send_packet('U', bytes("01 00 00 00 07"), other);
  assert_pace(Pace::kAtOnce);
  tick();
  answer();
  g_bench->close(other);  // left without an answer
  assert_pace(Pace::kAtOnce);
}

void a_new_client_in_the_place_of_another_begins_anew(void**) {
  close_loop();
  make_steady();
  g_bench->close(g_client);
  assert_pace(Pace::kByTime);
  assert_int_equal(g_bench->open(Service::kRtde), g_client);
  send_packet('I', "input_int_register_24", g_client);
  g_bench.send(g_client, session_stream());
  tick();
  assert_pace(Pace::kByTime);
}

void a_package_that_cannot_be_read_is_no_answer(void**) {
  close_loop();
  tick();
  send_packet('U', bytes("01 00 00"), g_client);
  send_packet('U', bytes("09 00 00 00 07"), g_client);
  assert_pace(Pace::kByTime);
}

}  // namespace
}  // namespace tactus::ur

int main() {
  using namespace tactus::ur;
  const CMUnitTest tests[] = {
      cmocka_unit_test(an_answer_lets_the_next_cycle_begin),
      cmocka_unit_test(without_a_client_that_closes_a_loop_cycles_keep_their_time),
      cmocka_unit_test(a_client_that_always_answered_is_waited_for),
      cmocka_unit_test(a_set_point_that_did_not_wait_for_its_packet_counts_for_it),
      cmocka_unit_test(a_client_is_no_more_than_some_cycles_ahead),
      cmocka_unit_test(all_that_close_a_loop_must_have_answered),
      cmocka_unit_test(a_new_client_in_the_place_of_another_begins_anew),
      cmocka_unit_test(a_package_that_cannot_be_read_is_no_answer),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
