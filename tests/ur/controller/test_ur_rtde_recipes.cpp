// Tests the recipes of the emulated controller: names, claims, written values, and malformed
// requests.
#include "tests/ur/controller/ur_rtde_client.hpp"

namespace tactus::ur {
namespace {

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

}  // namespace
}  // namespace tactus::ur

int main() {
  using namespace tactus::ur;
  const CMUnitTest tests[] = {
      cmocka_unit_test(unknown_names_and_names_in_use_are_said_in_place_of_a_type),
      cmocka_unit_test(what_is_written_shows_in_the_outputs),
      cmocka_unit_test(broken_packets_are_named_and_harm_nothing),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
