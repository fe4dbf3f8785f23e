// What `tactus scan` prints about a node.
#include <cstdlib>
#include <cstring>

#include "program/scan/node_text.hpp"
#include "tests/support/testing.hpp"

namespace tactus::can {
namespace {

void assert_printed(int node, const NodeReport& report, const char* expected) {
  static char text[8192];
  std::memset(text, 0, sizeof text);
  std::FILE* out = fmemopen(text, sizeof text, "w");
  print_node(out, node, report);
  std::fclose(out);
  assert_string_equal(text, expected);
}

NodeReport drive() {
  NodeReport report;
  report.answers = report.heard = true;
  report.nmt = NmtState::kOperational;
  report.set(Item::kType, 0x00020192);
  report.set(Item::kVendor, 0xAABB);
  report.set(Item::kProduct, 402);
  report.set(Item::kSerial, 1003);
  report.set(Item::kRegister, 0x21);
  report.set(Item::kErrorCount, 1);
  report.set(Item::kHeartbeatTime, 50);
  report.set(Item::kErrorCode, 0x8611);
  report.set(Item::kStatusword, 0x0637);
  report.set(Item::kModeDisplay, 10);
  report.set(Item::kSupportedModes, 0x3A0);
  report.set(Item::kRatedTorque, 3000);
  report.set(Item::kIncrements, 16777216);
  report.set(Item::kRevolutions, 1);
  report.labels[0] = NodeReport::Label("Servo drive");
  report.labels[2] = NodeReport::Label("1.2");
  report.history[0] = 0x12348130;
  report.history_count = 1;
  report.rpdos[0] = {true, 0x201, 1, 3, {0x60400010, 0x60710010, 0x00060010}};
  report.tpdos[1] = {true, 0x40000281, 255, 0, {}};
  report.tpdos[2] = {true, 0x80000381, 1, 1, {0x60410010}};
  return report;
}

// Proves CAN-16.
void a_drive_is_printed_line_by_line(void**) {
  assert_printed(
      3, drive(),
      "node 3: a drive (CiA 402), Servo drive, firmware 1.2\n"
      "  identity  vendor 0000AABBh, product 00000192h, serial number 1003\n"
      "  NMT       operational, a heartbeat every 50 ms\n"
      "  drive     operation enabled (statusword 0637h), mode 10 cst; supports hm csp csv "
      "cst\n"
      "  scaling   rated torque 3000 mN m, 16777216 increments per 1 revolution\n"
      "  errors    register 21h, code 8611h following error, 1 in the history\n"
      "            1: 8130h the master's heartbeat is missing, additional 1234h\n"
      "  RPDO 1    201h at every SYNC: 6040h:0 controlword (16), 6071h:0 target torque "
      "(16), skip (16)\n"
      "  TPDO 2    281h at an event: nothing is mapped\n");
}

void a_stopped_node_is_printed_with_its_state(void**) {
  NodeReport report;
  report.heard = true;
  report.nmt = NmtState::kStopped;
  assert_printed(9, report,
                 "node 9: a device of unknown type\n"
                 "  NMT       stopped\n"
                 "  SDO       it answers no request\n");
}

void what_is_not_known_is_not_printed(void**) {
  NodeReport report;
  report.answers = true;
  report.set(Item::kType, 0x00030191);
  report.set(Item::kRegister, 0);
  report.set(Item::kHeartbeatTime, 0);
  report.rpdos[3] = {true, kPdoInvalid, 0, 0, {}};
  report.trouble = Message("node 9: object 1008h:0: no answer within 100 ms (05040000h)");
  assert_printed(9, report,
                 "node 9: a device of profile 401\n"
                 "  NMT       no heartbeat was heard, heartbeat off\n"
                 "  errors    register 00h\n"
                 "  PDOs      none is in use\n"
                 "  stopped   node 9: object 1008h:0: no answer within 100 ms (05040000h)\n");
}

void a_node_that_answers_only_with_aborts_has_two_lines(void**) {
  NodeReport report;
  report.answers = true;
  assert_printed(9, report,
                 "node 9: a device of unknown type\n"
                 "  NMT       no heartbeat was heard\n");
}

void odd_values_are_printed_as_they_are(void**) {
  NodeReport report = drive();
  report.set(Item::kModeDisplay, 0xFF);
  report.set(Item::kStatusword, 0xFFFFFFFF);
  report.rpdos[0] = {true, 0x201, 7, 200, {}};
  for (std::uint32_t& entry : report.rpdos[0].entries) entry = 0x20000108;
  static char text[8192];
  std::memset(text, 0, sizeof text);
  std::FILE* out = fmemopen(text, sizeof text, "w");
  print_node(out, 1, report);
  std::fclose(out);
  assert_non_null(std::strstr(text, "(statusword FFFFh), mode -1; supports"));
  assert_non_null(std::strstr(text, "201h at every 7th SYNC: 2000h:1 (8), 2000h:1 (8),"));
  assert_non_null(std::strstr(text, ", and 184 more\n"));
}

}  // namespace
}  // namespace tactus::can

int main() {
  using namespace tactus::can;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_drive_is_printed_line_by_line),
      cmocka_unit_test(a_stopped_node_is_printed_with_its_state),
      cmocka_unit_test(what_is_not_known_is_not_printed),
      cmocka_unit_test(a_node_that_answers_only_with_aborts_has_two_lines),
      cmocka_unit_test(odd_values_are_printed_as_they_are),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
