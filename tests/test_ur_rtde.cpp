// RTDE of the emulated controller, against the packets that the vendor's Python client was seen to
// send and accept, and against streams that are cut, glued and broken.
#include <cstdio>

#include "tests/ur_bench.hpp"
#include "tests/testing.hpp"

namespace tactus::ur {
namespace {

Bench g_bench;
int g_client = -1;

/// Bytes of a text in hexadecimal, blanks left out.
std::string_view bytes(const char* hex) {
  static std::array<char, 4096> out;
  std::size_t size = 0;
  for (unsigned value = 0; *hex != '\0';) {
    if (*hex == ' ') {
      ++hex;
      continue;
    }
    std::sscanf(hex, "%2x", &value);
    out[size++] = static_cast<char>(value);
    hex += 2;
  }
  return {out.data(), size};
}

void connect() {
  g_bench.start();
  assert_true(g_bench.started());
  g_client = g_bench->open(Service::kRtde);
  assert_true(g_client >= 0);
}

/// A packet: its type, and its payload.
void send(char type, std::string_view payload, int client) {
  std::array<char, 16384> packet;
  const std::size_t size = payload.size() + 3;
  packet[0] = static_cast<char>(size >> 8);
  packet[1] = static_cast<char>(size & 0xff);
  packet[2] = type;
  std::memcpy(packet.data() + 3, payload.data(), payload.size());
  g_bench.send(client, {packet.data(), size});
}

void expect_text(std::string_view actual, std::string_view expected) {
  assert_int_equal(actual.size(), expected.size());
  assert_memory_equal(actual.data(), expected.data(), expected.size());
}

constexpr const char* kVersion2 = "00 05 56 00 02";
constexpr const char* kOutputs = "00 36 4f 40 5f 40 00 00 00 00 00";
constexpr std::string_view kNames = "timestamp,actual_q,robot_mode,runtime_state";
constexpr const char* kStart = "00 03 53";

/// The client's side of a session at 125 Hz, as one stream.
std::string_view session_stream() {
  static std::array<char, 256> stream;
  std::size_t size = 0;
  const auto add = [&](std::string_view part) {
    std::memcpy(stream.data() + size, part.data(), part.size());
    size += part.size();
  };
  add(bytes(kVersion2));
  add(bytes("00 03 76"));
  add(bytes(kOutputs));
  add(kNames);
  add(bytes(kStart));
  return {stream.data(), size};
}
constexpr const char* kReplies =
    "00 04 56 01  00 13 76 00 00 00 03 00 00 00 0f 00 00 00 08 00 01 9f 63  00 20 4f 01"
    "44 4f 55 42 4c 45 2c 56 45 43 54 4f 52 36 44 2c 49 4e 54 33 32 2c 55 49 4e 54 33 32"
    "00 04 53 01";

// Proves URE-1.

void a_session_is_answered_byte_for_byte(void**) {
  connect();
  g_bench.send(g_client, session_stream());
  expect_text(g_bench.take(g_client), bytes(kReplies));
}

void a_stream_cut_at_every_byte_is_the_same_stream(void**) {
  for (std::size_t cut = 0; cut <= session_stream().size(); ++cut) {
    connect();
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
  for (int i = 0; i < 6; ++i) ASSERT_NEAR(reader.f64(), settings.initial_q[i], 1e-9);
  assert_int_equal(reader.u32(), 7);
  assert_int_equal(reader.u32(), 1);  // no program
  assert_true(reader.done());
}

void version_1_has_no_frequency_and_no_recipe_number(void**) {
  connect();
  send('O', "timestamp,robot_mode", g_client);
  expect_text(g_bench.take(g_client).substr(3), "DOUBLE,INT32");
  send('S', "", g_client);
  g_bench.take(g_client);
  g_bench.ticks(1);
  assert_int_equal(g_bench.take(g_client).size(), 3 + 8 + 4);
  send('V', std::string_view("\0\3", 2), g_client);
  expect_text(g_bench.take(g_client), bytes("00 04 56 00"));
}

// Proves URE-2.

void samples_stand_on_the_grid_of_their_rate(void**) {
  connect();
  g_bench.send(g_client, bytes(kVersion2));
  std::array<char, 32> setup{};
  ByteWriter writer(reinterpret_cast<std::uint8_t*>(setup.data()), setup.size());
  writer.f64(25.0);
  writer.text("timestamp");
  send('O', {setup.data(), writer.size()}, g_client);
  send('S', "", g_client);
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
  connect();
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

// Proves URE-3.

void unknown_names_and_names_in_use_are_said_in_place_of_a_type(void**) {
  connect();
  send('I', "speed_slider_mask,no_such_name", g_client);
  expect_text(g_bench.take(g_client).substr(3), std::string_view("\0UINT32,NOT_FOUND", 17));
  send('I', "input_int_register_0,speed_slider_mask,speed_slider_fraction,", g_client);
  expect_text(g_bench.take(g_client).substr(3), "\1INT32,UINT32,DOUBLE");
  send('I', "input_int_register_0", g_client);  // the same connection may, again
  expect_text(g_bench.take(g_client).substr(3), "\2INT32");
  const int other = g_bench->open(Service::kRtde);
  send('I', "input_int_register_0,input_int_register_1", other);
  expect_text(g_bench.take(other).substr(3), std::string_view("\0IN_USE,INT32", 13));
  g_bench->close(g_client);
  send('I', "input_int_register_0,input_int_register_1", other);
  expect_text(g_bench.take(other).substr(3), "\1INT32,INT32");
  send('V', std::string_view("\0\2", 2), other);
  g_bench.take(other);
  std::array<char, 64> setup{};
  ByteWriter writer(reinterpret_cast<std::uint8_t*>(setup.data()), setup.size());
  writer.f64(125.0);
  writer.text("timestamp,ft_raw_wrench");
  send('O', {setup.data(), writer.size()}, other);
  expect_text(g_bench.take(other).substr(3), "\1DOUBLE,NOT_FOUND");
  send('S', "", other);
  g_bench.ticks(1);
  assert_int_equal(g_bench.take(other).size(), 4);  // not accepted for lack of outputs: no data
}

void what_is_written_shows_in_the_outputs(void**) {
  connect();
  send('I', "speed_slider_mask,speed_slider_fraction", g_client);
  expect_text(g_bench.take(g_client), bytes("00 11 49 01 55 49 4e 54 33 32 2c 44 4f 55 42 4c 45"));
  g_bench.send(g_client, bytes("00 10 55 01 00 00 00 01 3f e0 00 00 00 00 00 00"));
  g_bench.ticks(1);
  assert_true(g_bench.image().target_speed_fraction == 0.5);
  send('I', "standard_digital_output_mask,standard_digital_output,input_double_register_24", g_client);
  g_bench.send(g_client, bytes("00 0e 55 02 0f 05 40 09 21 fb 54 44 2d 18"));
  g_bench.ticks(1);
  assert_int_equal(g_bench.image().actual_digital_output_bits, 5);
  ASSERT_NEAR(g_bench.image().input.doubles[24], 3.141592653589793, 0.0);
}

// Proves URE-4.

void broken_packets_are_named_and_harm_nothing(void**) {
  connect();
  g_bench.send(g_client, bytes(kVersion2));
  g_bench.take(g_client);
  send('U', "\1", g_client);  // no such recipe
  assert_int_equal(g_bench.take(g_client)[2], 'M');
  send('?', "what", g_client);
  assert_int_equal(g_bench.take(g_client)[2], 'M');
  assert_false(g_bench->ended(g_client));
  g_bench.send(g_client, bytes("00 02 56"));  // shorter than its header
  assert_true(g_bench->ended(g_client));
}

void no_stream_of_bytes_does_harm(void**) {
  std::uint32_t state = 1;
  const auto next = [&] { return state = state * 1664525u + 1013904223u, state >> 24; };
  for (int trial = 0; trial < 300; ++trial) {
    if (trial % 50 == 0) connect();
    const int client = g_bench->open(Service::kRtde);
    for (int n = 0; n < 8; ++n) {
      std::array<char, 64> noise;
      const std::size_t size = 3 + next() % 50;
      for (char& c : noise) c = static_cast<char>(next());
      noise[0] = 0;
      noise[1] = static_cast<char>(size);
      constexpr std::string_view kTypes = "VvMUOISP";
      noise[2] = kTypes[next() % kTypes.size()];
      g_bench.send(client, {noise.data(), size});
    }
    g_bench.ticks(1);
    g_bench.take(client);
    g_bench->close(client);
  }
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
      cmocka_unit_test(pause_is_answered_while_data_flow_and_start_goes_on),
      cmocka_unit_test(unknown_names_and_names_in_use_are_said_in_place_of_a_type),
      cmocka_unit_test(what_is_written_shows_in_the_outputs),
      cmocka_unit_test(broken_packets_are_named_and_harm_nothing),
      cmocka_unit_test(no_stream_of_bytes_does_harm),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
