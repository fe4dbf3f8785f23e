// Tests RTDE of the emulated controller against packets recorded from the vendor's Python client,
// and with streams that are cut, concatenated and corrupted.
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
  g_bench.send(g_client, bytes(kStart));
  expect_text(g_bench.take(g_client), bytes("00 04 53 01"));  // before any data
  g_bench.ticks(1);
  assert_int_equal(g_bench.take(g_client).size(), 68);
}

void a_start_without_outputs_is_refused(void**) {
  connect_rtde();
  send_packet('V', std::string_view("\0\2", 2), g_client);
  send_packet('I', "input_int_register_0", g_client);
  g_bench.take(g_client);
  g_bench.send(g_client, bytes(kStart));
  expect_text(g_bench.take(g_client), bytes("00 04 53 00"));
  g_bench.send(g_client, session_stream());
  expect_text(g_bench.take(g_client), bytes(kReplies));
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
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
