// Tests RTDE of the emulated controller against packets recorded from the vendor's Python client;
// its recipes: names, claims, written values, malformed requests; and when the next cycle may begin
// early. Sessions are in memory, cycles by hand.
#include "tests/ur/controller/ur_rtde_client.hpp"

namespace tactus::ur {
namespace {

// Proves URE-1.

void a_session_is_answered_byte_for_byte(void**) {
  connect_rtde();
  g_bench.send(g_client, session_stream());
  expect_text(g_bench.take(g_client), bytes(kReplies));
}

void a_stream_cut_at_every_byte_is_the_same_stream(void**) {
  for (std::size_t cut = 0; cut <= session_stream().size(); ++cut) {
    connect_rtde();
    g_bench.send(g_client, session_stream().substr(0, cut));
    g_bench.send(g_client, session_stream().substr(cut));
    expect_text(g_bench.take(g_client), bytes(kReplies));
  }
}

void a_data_package_holds_the_fields_in_their_order(void**) {
  Settings settings;
  settings.start_time_s = 100.0;
  settings.initial_q << 0.0, -1.2, 1.2, -0.1, 1.57, 0.0;
  g_bench.start(settings);
  g_client = g_bench->open(Service::kRtde);
  g_bench.send(g_client, session_stream());
  g_bench.take(g_client);
  g_bench.ticks(1);
  ByteReader reader(g_bench->outbox(g_client).data(), g_bench->outbox(g_client).size());
  assert_int_equal(reader.u16(), 68);
  assert_int_equal(reader.u8(), 0x55);
  assert_int_equal(reader.u8(), 1);
  assert_true(reader.f64() == 100.008);
  for (int i = 0; i < 6; ++i) ASSERT_NEAR(reader.f64(), settings.initial_q[i], kEncoder_rad);
  assert_int_equal(reader.u32(), 7);
  assert_int_equal(reader.u32(), 1);  // no program
  assert_true(reader.done());
}

void version_1_has_no_frequency_and_no_recipe_number(void**) {
  connect_rtde();
  send_packet('O', "timestamp,robot_mode", g_client);
  expect_text(g_bench.take(g_client).substr(3), "DOUBLE,INT32");
  send_packet('S', "", g_client);
  g_bench.take(g_client);
  g_bench.ticks(1);
  assert_int_equal(g_bench.take(g_client).size(), 3 + 8 + 4);
  send_packet('V', std::string_view("\0\3", 2), g_client);
  expect_text(g_bench.take(g_client), bytes("00 04 56 00"));
}

// Proves URE-2.

void samples_stand_on_the_grid_of_their_rate(void**) {
  connect_rtde();
  g_bench.send(g_client, bytes(kVersion2));
  std::array<char, 32> setup{};
  ByteWriter writer(reinterpret_cast<std::uint8_t*>(setup.data()), setup.size());
  writer.f64(25.0);
  writer.text("timestamp");
  send_packet('O', {setup.data(), writer.size()}, g_client);
  send_packet('S', "", g_client);
  g_bench.take(g_client);
  double last = 0.0;
  int samples = 0;
  for (int i = 0; i < 500; ++i) {
    g_bench.ticks(1);
    Outbox& out = g_bench->outbox(g_client);
    if (out.empty()) continue;
    ByteReader reader(out.data() + 4, 8);
    const double stamp = reader.f64();
    if (samples > 0) ASSERT_NEAR(stamp - last, 0.04, 1e-9);
    last = stamp;
    ++samples;
    out.sent(out.size());
  }
  assert_int_equal(samples, 100);
}

void pause_is_answered_while_data_flow_and_start_goes_on(void**) {
  connect_rtde();
  g_bench.send(g_client, session_stream());
  g_bench.ticks(3);
  g_bench.take(g_client);
  g_bench.ticks(1);
  g_bench.send(g_client, bytes("00 03 50"));
  const std::string_view got = g_bench.take(g_client);
  expect_text(got.substr(got.size() - 4), bytes("00 04 50 01"));
  g_bench.ticks(5);
  assert_true(g_bench.take(g_client).empty());
  g_bench.send(g_client, bytes(kBegin));
  expect_text(g_bench.take(g_client), bytes("00 04 53 01"));  // before any data
  g_bench.ticks(1);
  assert_int_equal(g_bench.take(g_client).size(), 68);
}

void a_start_without_outputs_is_refused(void**) {
  connect_rtde();
  send_packet('V', std::string_view("\0\2", 2), g_client);
  send_packet('I', "input_int_register_0", g_client);
  g_bench.take(g_client);
  g_bench.send(g_client, bytes(kBegin));
  expect_text(g_bench.take(g_client), bytes("00 04 53 00"));
  g_bench.send(g_client, session_stream());
  expect_text(g_bench.take(g_client), bytes(kReplies));
}

// Proves URE-3.

void unknown_names_and_names_in_use_are_said_in_place_of_a_type(void**) {
  connect_rtde();
  send_packet('I', "speed_slider_mask,no_such_name", g_client);
  expect_text(g_bench.take(g_client).substr(3), std::string_view("\0UINT32,NOT_FOUND", 17));
  send_packet('I', "input_int_register_0,speed_slider_mask,speed_slider_fraction,", g_client);
  expect_text(g_bench.take(g_client).substr(3), "\1INT32,UINT32,DOUBLE");
  send_packet('I', "input_int_register_0", g_client);  // the same connection may, again
  expect_text(g_bench.take(g_client).substr(3), "\2INT32");
  const int other = g_bench->open(Service::kRtde);
  send_packet('I', "input_int_register_0,input_int_register_1", other);
  expect_text(g_bench.take(other).substr(3), std::string_view("\0IN_USE,INT32", 13));
  g_bench->close(g_client);
  send_packet('I', "input_int_register_0,input_int_register_1", other);
  expect_text(g_bench.take(other).substr(3), "\1INT32,INT32");
  send_packet('V', std::string_view("\0\2", 2), other);
  g_bench.take(other);
  std::array<char, 64> setup{};
  ByteWriter writer(reinterpret_cast<std::uint8_t*>(setup.data()), setup.size());
  writer.f64(125.0);
  writer.text("timestamp,ft_raw_wrench");
  send_packet('O', {setup.data(), writer.size()}, other);
  expect_text(g_bench.take(other).substr(3), "\1DOUBLE,NOT_FOUND");
  send_packet('S', "", other);
  g_bench.ticks(1);
  assert_int_equal(g_bench.take(other).size(), 4);  // not accepted for lack of outputs: no data
}

void what_is_written_shows_in_the_outputs(void**) {
  connect_rtde();
  send_packet('I', "speed_slider_mask,speed_slider_fraction", g_client);
  expect_text(g_bench.take(g_client), bytes("00 11 49 01 55 49 4e 54 33 32 2c 44 4f 55 42 4c 45"));
  g_bench.send(g_client, bytes("00 10 55 01 00 00 00 01 3f e0 00 00 00 00 00 00"));
  g_bench.ticks(1);
  assert_true(g_bench.image().target_speed_fraction == 0.5);
  send_packet('I', "standard_digital_output_mask,standard_digital_output,input_double_register_24",
              g_client);
  g_bench.send(g_client, bytes("00 0e 55 02 0f 05 40 09 21 fb 54 44 2d 18"));
  g_bench.ticks(1);
  assert_int_equal(g_bench.image().actual_digital_output_bits, 5);
  ASSERT_NEAR(g_bench.image().input.doubles[24], 3.141592653589793, 0.0);
}

// Proves URE-4.

void broken_packets_are_named_and_harm_nothing(void**) {
  connect_rtde();
  g_bench.send(g_client, bytes(kVersion2));
  g_bench.take(g_client);
  send_packet('U', "\1", g_client);  // no such recipe
  assert_int_equal(g_bench.take(g_client)[2], 'M');
  send_packet('?', "what", g_client);
  assert_int_equal(g_bench.take(g_client)[2], 'M');
  assert_false(g_bench->ended(g_client));
  g_bench.send(g_client, bytes("00 02 56"));  // shorter than its header
  assert_true(g_bench->ended(g_client));
}

/// Opens a client that receives packets and writes a register.
void close_loop() {
  connect_rtde();
  send_packet('I', "input_int_register_24", g_client);
  g_bench.send(g_client, session_stream());
  g_bench.take(g_client);
}
void answer_packet() {
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
    answer_packet();
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
    answer_packet();
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
  answer_packet();  // answers the last packet only
  assert_pace(Pace::kAtOnce);
}

void a_set_point_that_did_not_wait_for_its_packet_counts_for_it(void**) {
  close_loop();
  make_steady();
  answer_packet();
  answer_packet();
  tick();
  assert_pace(Pace::kAtOnce);
  tick();
  assert_pace(Pace::kAtOnce);
  tick();
  assert_pace(Pace::kWaits);
}

void a_client_is_no_more_than_some_cycles_ahead(void**) {
  close_loop();
  for (int i = 0; i < 1000; ++i) answer_packet();
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
  answer_packet();
  assert_pace(Pace::kByTime);
  send_packet('U', bytes("01 00 00 00 07"), other);
  assert_pace(Pace::kAtOnce);
  tick();
  answer_packet();
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
      cmocka_unit_test(a_session_is_answered_byte_for_byte),
      cmocka_unit_test(a_stream_cut_at_every_byte_is_the_same_stream),
      cmocka_unit_test(a_data_package_holds_the_fields_in_their_order),
      cmocka_unit_test(version_1_has_no_frequency_and_no_recipe_number),
      cmocka_unit_test(samples_stand_on_the_grid_of_their_rate),
      cmocka_unit_test(a_start_without_outputs_is_refused),
      cmocka_unit_test(pause_is_answered_while_data_flow_and_start_goes_on),
      cmocka_unit_test(unknown_names_and_names_in_use_are_said_in_place_of_a_type),
      cmocka_unit_test(what_is_written_shows_in_the_outputs),
      cmocka_unit_test(broken_packets_are_named_and_harm_nothing),
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
