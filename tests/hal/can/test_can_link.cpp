// How a CanSocket is opened and refused, and what error frames of the controller mean.
#include <fcntl.h>
#include <linux/can/error.h>

#include <cstdio>
#include <memory>
#include <string_view>

#include "tests/hal/can/can_pair.hpp"
#include "tests/support/testing.hpp"

namespace tactus::can {
namespace {

std::unique_ptr<CanPair> g_pair;
CanFrame g_frame;

struct Report {
  std::uint32_t classes;
  std::uint8_t controller = 0, tx_errors = 0, rx_errors = 0;
};
/// Receives an error frame and returns the health after it.
const LinkHealth& after(const Report& report) {
  can_frame raw{};
  raw.can_id = CAN_ERR_FLAG | report.classes;
  raw.can_dlc = CAN_ERR_DLC;
  raw.data[1] = report.controller;
  raw.data[6] = report.tx_errors;
  raw.data[7] = report.rx_errors;
  if (!g_pair->put(&raw, sizeof raw)) print_error("the packet was not sent\n");
  assert_int_equal(g_pair->can.receive(&g_frame, 1), 0);
  return g_pair->can.health();
}

// Proves CAN-6.
void the_state_of_the_controller_follows_its_reports(void**) {
  g_pair = std::make_unique<CanPair>();
  assert_true(after({CAN_ERR_CRTL, CAN_ERR_CRTL_TX_WARNING}).warning);
  assert_false(after({CAN_ERR_CRTL, CAN_ERR_CRTL_RX_WARNING}).error_passive);
  assert_true(after({CAN_ERR_CRTL, CAN_ERR_CRTL_TX_PASSIVE}).error_passive);
  assert_true(g_pair->can.health().warning);
  assert_false(after({CAN_ERR_CRTL, CAN_ERR_CRTL_RX_WARNING}).error_passive);
  assert_true(g_pair->can.health().warning);
  assert_true(after({CAN_ERR_CRTL, CAN_ERR_CRTL_RX_PASSIVE}).error_passive);
  assert_false(after({CAN_ERR_CRTL, CAN_ERR_CRTL_ACTIVE}).error_passive);
  assert_false(g_pair->can.health().warning);
  assert_int_equal(g_pair->can.health().error_frames, 6);
}

void an_overflow_does_not_change_the_state(void**) {
  g_pair = std::make_unique<CanPair>();
  (void)after({CAN_ERR_CRTL, CAN_ERR_CRTL_TX_PASSIVE});
  const LinkHealth& health = after({CAN_ERR_CRTL, CAN_ERR_CRTL_RX_OVERFLOW});
  assert_true(health.error_passive);
  assert_int_equal(health.overflows, 1);
}

void bus_off_lasts_until_the_controller_is_restarted(void**) {
  g_pair = std::make_unique<CanPair>();
  assert_true(after({CAN_ERR_BUSOFF}).bus_off);
  assert_true(after({CAN_ERR_BUSERROR | CAN_ERR_PROT}).bus_off);
  assert_int_equal(g_pair->can.health().restarted, 0);
  const LinkHealth& health = after({CAN_ERR_RESTARTED});
  assert_false(health.bus_off);
  assert_int_equal(health.restarted, 1);
  assert_int_equal(health.bus_errors, 1);
}

void counters_are_those_of_the_last_report_that_has_them(void**) {
  g_pair = std::make_unique<CanPair>();
  const LinkHealth& health = after({CAN_ERR_ACK | 0x200, 0, 136, 7});
  assert_int_equal(health.tx_errors, 136);
  assert_int_equal(health.rx_errors, 7);
  assert_int_equal(health.unacknowledged, 1);
  assert_int_equal(after({CAN_ERR_ACK, 0, 1, 1}).tx_errors, 136);
}

void a_report_passes_every_filter_and_is_no_frame(void**) {
  constexpr CanFilter kOnly = {0x181, 0x7FF};
  g_pair = std::make_unique<CanPair>(false, &kOnly, 1);
  assert_true(after({CAN_ERR_BUSOFF}).bus_off);
}

void a_report_of_another_length_is_malformed(void**) {
  g_pair = std::make_unique<CanPair>(true);
  canfd_frame raw{};
  raw.can_id = CAN_ERR_FLAG | CAN_ERR_BUSOFF;
  raw.len = 8;
  assert_true(g_pair->put(&raw, CANFD_MTU));
  raw.len = 2;
  assert_true(g_pair->put(&raw, CAN_MTU));
  assert_int_equal(g_pair->can.receive(&g_frame, 1), 0);
  assert_int_equal(g_pair->can.receive(&g_frame, 1), 0);
  assert_int_equal(g_pair->can.health().malformed, 2);
  assert_false(g_pair->can.health().bus_off);
}

void opening_again_forgets_the_old_link(void**) {
  g_pair = std::make_unique<CanPair>();
  (void)after({CAN_ERR_BUSOFF});
  int ends[2] = {-1, -1};
  assert_int_equal(socketpair(AF_UNIX, SOCK_SEQPACKET, 0, ends), 0);
  ::close(ends[1]);
  g_pair->can.adopt(ends[0], false);
  assert_false(g_pair->can.health().bus_off);
  assert_int_equal(g_pair->can.system_calls(), 0);
}

void refused(const char* interface, Status status, std::string_view reason) {
  static CanSocket can;
  static Message why;
  ASSERT_STATUS(can.open(interface, false, nullptr, 0, why), status);
  assert_false(can.is_open());
  const std::string_view said = why;
  if (said.find(reason) == std::string_view::npos) print_error("%s\n", why.c_str());
  assert_true(said.find(reason) != std::string_view::npos);
}

void an_inherited_packet_socket_is_opened_by_its_number(void**) {
  static CanSocket can;
  static Message why;
  int ends[2] = {-1, -1};
  assert_int_equal(socketpair(AF_UNIX, SOCK_SEQPACKET, 0, ends), 0);
  char name[16] = {};
  std::snprintf(name, sizeof name, "fd:%d", ends[0]);
  constexpr CanFilter kOnly = {0x181, 0x7FF};
  ASSERT_OK(can.open(name, false, &kOnly, 1, why));
  assert_true((fcntl(ends[0], F_GETFL) & O_NONBLOCK) != 0);
  assert_true((fcntl(ends[0], F_GETFD) & FD_CLOEXEC) != 0);
  can_frame raw{};
  raw.can_id = 0x182;
  assert_int_equal(::send(ends[1], &raw, sizeof raw, 0), 16);
  raw.can_id = 0x181;
  assert_int_equal(::send(ends[1], &raw, sizeof raw, 0), 16);
  assert_true(can.wait(0) == WaitResult::kSomething);
  assert_int_equal(can.receive(&g_frame, 1) + can.receive(&g_frame, 1), 1);
  assert_int_equal(g_frame.id, 0x181);
  can.close();
  ::close(ends[1]);
}

void what_is_no_packet_socket_is_refused(void**) {
  refused("fd:", Status::kConnectionLost, "after fd: comes the number of a descriptor");
  refused("fd:3x", Status::kConnectionLost, "after fd: comes the number of a descriptor");
  refused("fd:-1", Status::kConnectionLost, "after fd: comes the number of a descriptor");
  refused("fd:99999999999", Status::kConnectionLost, "after fd: comes the number");
  refused("fd:900", Status::kConnectionLost, "bus fd:900: the descriptor is not an open packet");
  int pipes[2] = {-1, -1}, streams[2] = {-1, -1};
  assert_int_equal(pipe(pipes), 0);
  assert_int_equal(socketpair(AF_UNIX, SOCK_STREAM, 0, streams), 0);
  char name[16] = {};
  for (const int descriptor : {pipes[0], streams[0]}) {
    std::snprintf(name, sizeof name, "fd:%d", descriptor);
    refused(name, Status::kConnectionLost, "not an open packet socket");
  }
  for (const int descriptor : {pipes[0], pipes[1], streams[0], streams[1]}) ::close(descriptor);
}

void an_interface_that_is_not_there_is_named(void**) {
  const int probe = ::socket(PF_CAN, SOCK_RAW, CAN_RAW);
  if (probe >= 0) ::close(probe);
  if (probe < 0)
    refused("nocan7", Status::kNotOffered, "bus nocan7: ");
  else
    refused("nocan7", Status::kConnectionLost, "bus nocan7: there is no such interface");
}

void too_many_filters_are_refused(void**) {
  static CanSocket can;
  static Message why;
  static CanFilter filters[CanSocket::kMostFilters + 1];
  ASSERT_STATUS(can.open("can0", false, filters, CanSocket::kMostFilters + 1, why),
                Status::kTooLarge);
  assert_string_equal(why.c_str(), "bus can0: 65 filters, at most 64");
}

}  // namespace
}  // namespace tactus::can

int main() {
  using namespace tactus::can;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_state_of_the_controller_follows_its_reports),
      cmocka_unit_test(an_overflow_does_not_change_the_state),
      cmocka_unit_test(bus_off_lasts_until_the_controller_is_restarted),
      cmocka_unit_test(counters_are_those_of_the_last_report_that_has_them),
      cmocka_unit_test(a_report_passes_every_filter_and_is_no_frame),
      cmocka_unit_test(a_report_of_another_length_is_malformed),
      cmocka_unit_test(opening_again_forgets_the_old_link),
      cmocka_unit_test(an_inherited_packet_socket_is_opened_by_its_number),
      cmocka_unit_test(what_is_no_packet_socket_is_refused),
      cmocka_unit_test(an_interface_that_is_not_there_is_named),
      cmocka_unit_test(too_many_filters_are_refused),
  };
  const int failed = cmocka_run_group_tests(tests, nullptr, nullptr);
  g_pair.reset();
  return failed;
}
