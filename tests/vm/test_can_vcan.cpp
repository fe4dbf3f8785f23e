// A CanSocket on a virtual CAN bus of the kernel: what it relies on is what the kernel does.
#include <linux/can/error.h>

#include <array>
#include <ctime>
#include <memory>

#include "tests/support/testing.hpp"
#include "tests/vm/can_bus.hpp"

namespace tactus::can {
namespace {

constexpr const char* kBus = "vcan0";
constexpr std::int64_t kSecond_ns = 1'000'000'000;

// A failed assertion is a longjmp, so the bus is not on the stack.
std::unique_ptr<CanBus> g_bus;
std::array<CanFrame, CanSocket::kBatch> g_frames;

CanBus& fresh(bool fd = false, const CanFilter* filters = nullptr, int count = 0) {
  if (if_nametoindex(kBus) == 0) _skip(__FILE__, __LINE__);
  g_bus = std::make_unique<CanBus>(kBus, kBus, fd, filters, count);
  ASSERT_OK(g_bus->status);
  return *g_bus;
}
int receive(CanBus& bus) {
  return bus.can.receive(g_frames.data(), CanSocket::kBatch);
}

// Proves CAN-8.
void the_kernel_passes_only_frames_that_a_filter_names(void**) {
  constexpr std::array<CanFilter, 2> kFilters = {{{0x180, 0x780}, {0x081, 0x7FF}}};
  CanBus& bus = fresh(false, kFilters.data(), 2);
  for (const std::uint32_t id : {0x17FU, 0x180U, 0x1FFU, 0x200U, 0x080U, 0x081U})
    assert_true(bus.put_frame(id));
  assert_true(bus.put_frame(0x181 | CAN_EFF_FLAG));
  assert_int_equal(receive(bus), 3);
  assert_int_equal(g_frames[0].id, 0x180);
  assert_int_equal(g_frames[1].id, 0x1FF);
  assert_int_equal(g_frames[2].id, 0x081);
  assert_int_equal(bus.can.health().foreign, 0);
}

void frames_with_29_bits_are_only_counted(void**) {
  CanBus& bus = fresh();
  assert_true(bus.put_frame(0x181 | CAN_EFF_FLAG));
  assert_int_equal(receive(bus), 0);
  assert_int_equal(bus.can.health().foreign, 1);
}

void long_frames_of_64_bytes_pass_in_both_directions(void**) {
  CanBus& bus = fresh(true);
  CanFrame frame;
  frame.id = 0x201;
  frame.size = 64;
  frame.fd = true;
  for (std::uint8_t i = 0; i < 64; ++i) frame.data[i] = i;
  assert_int_equal(static_cast<int>(bus.can.send(&frame, 1)), static_cast<int>(Sent::kAll));
  canfd_frame raw{};
  assert_int_equal(bus.take(raw), CANFD_MTU);
  assert_int_equal(raw.len, 64);
  assert_int_equal(raw.flags & CANFD_BRS, CANFD_BRS);
  assert_memory_equal(raw.data, frame.data.data(), 64);
  raw.can_id = 0x181;
  assert_true(bus.put(&raw, sizeof raw));
  assert_int_equal(receive(bus), 1);
  assert_int_equal(g_frames[0].size, 64);
  assert_true(g_frames[0].fd);
  assert_memory_equal(g_frames[0].data.data(), frame.data.data(), 64);
}

void long_frames_do_not_reach_a_link_of_classic_frames(void**) {
  CanBus& bus = fresh();
  canfd_frame raw{};
  raw.can_id = 0x181;
  raw.len = 12;
  assert_true(bus.put(&raw, sizeof raw));
  assert_true(bus.put_frame(0x182));
  assert_int_equal(receive(bus), 1);
  assert_int_equal(g_frames[0].id, 0x182);
  assert_int_equal(bus.can.health().malformed, 0);
}

void own_frames_do_not_come_back(void**) {
  CanBus& bus = fresh();
  CanFrame frame;
  frame.id = 0x201;
  assert_int_equal(static_cast<int>(bus.can.send(&frame, 1)), static_cast<int>(Sent::kAll));
  assert_int_equal(receive(bus), 0);
  canfd_frame raw{};
  assert_int_equal(bus.take(raw), CAN_MTU);
}

/// Writes an error frame as a controller's driver would.
const LinkHealth& after(CanBus& bus, canid_t classes, std::uint8_t controller = 0) {
  can_frame raw{};
  raw.can_id = CAN_ERR_FLAG | classes;
  raw.can_dlc = CAN_ERR_DLC;
  raw.data[1] = controller;
  assert_true(bus.put(&raw, sizeof raw));
  assert_int_equal(receive(bus), 0);
  return bus.can.health();
}

void reports_of_the_controller_arrive(void**) {
  CanBus& bus = fresh();
  assert_true(after(bus, CAN_ERR_CRTL, CAN_ERR_CRTL_TX_PASSIVE).error_passive);
  assert_true(after(bus, CAN_ERR_BUSOFF).bus_off);
  assert_false(after(bus, CAN_ERR_RESTARTED).bus_off);
  assert_int_equal(after(bus, CAN_ERR_ACK).unacknowledged, 1);
  assert_int_equal(bus.can.health().error_frames, 4);
  assert_int_equal(bus.can.health().restarted, 1);
  assert_false(bus.can.health().lost);
}

void reports_arrive_although_filters_name_other_frames(void**) {
  constexpr CanFilter kFilter = {0x181, 0x7FF};
  assert_true(after(fresh(false, &kFilter, 1), CAN_ERR_BUSOFF).bus_off);
}

void lost_arbitration_is_not_reported_because_it_is_no_fault(void**) {
  assert_int_equal(after(fresh(), CAN_ERR_LOSTARB).error_frames, 0);
}

std::int64_t real_time_ns() {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  return now.tv_sec * kSecond_ns + now.tv_nsec;
}
void each_frame_has_the_stamp_of_its_arrival_not_of_its_reading(void**) {
  CanBus& bus = fresh();
  const std::int64_t before_ns = real_time_ns();
  assert_true(bus.put_frame(0x181));
  const std::int64_t between_ns = real_time_ns();
  usleep(2000);
  assert_true(bus.put_frame(0x182));
  usleep(2000);
  assert_int_equal(receive(bus), 2);
  assert_true(g_frames[0].stamp_ns >= before_ns && g_frames[0].stamp_ns <= between_ns);
  assert_true(g_frames[1].stamp_ns >= between_ns + 2'000'000);
  assert_true(g_frames[1].stamp_ns <= real_time_ns() - 2'000'000);
}

void a_batch_is_one_system_call_in_each_direction_and_keeps_its_order(void**) {
  CanBus& bus = fresh();
  std::array<CanFrame, CanSocket::kBatch> batch;
  for (std::size_t i = 0; i < batch.size(); ++i) batch[i].id = static_cast<std::uint16_t>(i);
  assert_int_equal(static_cast<int>(bus.can.send(batch.data(), CanSocket::kBatch)), 0);
  canfd_frame raw{};
  for (std::uint32_t i = 0; i < batch.size(); ++i) {
    assert_int_equal(bus.take(raw), CAN_MTU);
    assert_int_equal(raw.can_id, i);
    assert_true(bus.put_frame(0x400 + i));
  }
  assert_int_equal(receive(bus), CanSocket::kBatch);
  for (std::uint32_t i = 0; i < batch.size(); ++i) assert_int_equal(g_frames[i].id, 0x400 + i);
  assert_int_equal(bus.can.system_calls(), 2);
}

void a_reader_that_sleeps_is_told_how_many_frames_it_lost(void**) {
  CanBus& bus = fresh();
  constexpr int kSent = 2000;
  for (int i = 0; i < kSent; ++i) assert_true(bus.put_frame(0x181));
  int got = 0;
  for (int now = receive(bus); now > 0; now = receive(bus)) got += now;
  assert_in_range(got, CanSocket::kBatch, kSent - 1);
  assert_true(bus.put_frame(0x182));
  assert_int_equal(receive(bus), 1);
  assert_int_equal(g_frames[0].id, 0x182);
  assert_int_equal(static_cast<int>(bus.can.health().dropped), kSent - got);
  assert_false(bus.can.health().lost);
}

void an_interface_that_goes_down_is_a_lost_link_until_it_is_opened_again(void**) {
  CanBus& bus = fresh();
  assert_true(set_up(kBus, false));
  assert_int_equal(receive(bus), 0);
  assert_true(bus.can.health().lost);
  CanFrame frame;
  assert_int_equal(static_cast<int>(bus.can.send(&frame, 1)), static_cast<int>(Sent::kLost));
  assert_true(set_up(kBus, true));
  assert_int_equal(static_cast<int>(bus.can.send(&frame, 1)), static_cast<int>(Sent::kLost));
  ASSERT_OK(bus.can.open(kBus, false, nullptr, 0, bus.why));
  assert_int_equal(static_cast<int>(bus.can.send(&frame, 1)), static_cast<int>(Sent::kAll));
}

void an_interface_that_was_down_between_two_cycles_is_a_lost_link(void**) {
  CanBus& bus = fresh();
  assert_true(set_up(kBus, false));
  assert_true(set_up(kBus, true));
  assert_int_equal(receive(bus), 0);
  assert_true(bus.can.health().lost);
}

void sending_on_an_interface_that_is_down_loses_the_link(void**) {
  CanBus& bus = fresh();
  assert_true(set_up(kBus, false));
  CanFrame frame;
  const Sent sent = bus.can.send(&frame, 1);
  assert_true(set_up(kBus, true));
  assert_int_equal(static_cast<int>(sent), static_cast<int>(Sent::kLost));
  assert_int_equal(bus.can.health().unsent, 1);
}

void refuses(const char* interface, bool fd, const char* reason) {
  if (if_nametoindex(kBus) == 0) _skip(__FILE__, __LINE__);
  g_bus = std::make_unique<CanBus>(interface, kBus, fd);
  assert_false(g_bus->can.is_open());
  if (std::strstr(g_bus->why.c_str(), reason) != nullptr) return;
  print_error("'%s' does not name '%s'\n", g_bus->why.c_str(), reason);
  _fail(__FILE__, __LINE__);
}
void an_interface_that_does_not_fit_is_refused_with_its_reason(void**) {
  refuses("vcan9", false, "there is no such interface");
  refuses("lo", false, "not a CAN interface");
  assert_true(set_up("vcan3", false));
  refuses("vcan3", false, "is down");
  assert_true(set_interface("vcan3", SIOCSIFMTU, [](ifreq& request) { request.ifr_mtu = 16; }));
  assert_true(set_up("vcan3", true));
  refuses("vcan3", true, "MTU is not 72");
}

}  // namespace
}  // namespace tactus::can

int main() {
  using namespace tactus::can;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_kernel_passes_only_frames_that_a_filter_names),
      cmocka_unit_test(frames_with_29_bits_are_only_counted),
      cmocka_unit_test(long_frames_of_64_bytes_pass_in_both_directions),
      cmocka_unit_test(long_frames_do_not_reach_a_link_of_classic_frames),
      cmocka_unit_test(own_frames_do_not_come_back),
      cmocka_unit_test(reports_of_the_controller_arrive),
      cmocka_unit_test(reports_arrive_although_filters_name_other_frames),
      cmocka_unit_test(lost_arbitration_is_not_reported_because_it_is_no_fault),
      cmocka_unit_test(each_frame_has_the_stamp_of_its_arrival_not_of_its_reading),
      cmocka_unit_test(a_batch_is_one_system_call_in_each_direction_and_keeps_its_order),
      cmocka_unit_test(a_reader_that_sleeps_is_told_how_many_frames_it_lost),
      cmocka_unit_test(an_interface_that_goes_down_is_a_lost_link_until_it_is_opened_again),
      cmocka_unit_test(an_interface_that_was_down_between_two_cycles_is_a_lost_link),
      cmocka_unit_test(sending_on_an_interface_that_is_down_loses_the_link),
      cmocka_unit_test(an_interface_that_does_not_fit_is_refused_with_its_reason),
  };
  const int failed = cmocka_run_group_tests(tests, nullptr, nullptr);
  g_bus.reset();
  return failed;
}
