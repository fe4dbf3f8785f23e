// A CanSocket on the kernel's virtual buses vcan0 and vcan1: skipped where there are none.
// `scripts/can-vm -- build/fer_can/tests/can/test_can_vcan` runs it in a machine that has them.
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/ioctl.h>

#include <array>
#include <ctime>
#include <string_view>

#include "tests/can/can_pair.hpp"
#include "tests/support/testing.hpp"

namespace tactus::can {
namespace {

CanSocket g_can, g_other;
Message g_why;
std::array<CanFrame, CanSocket::kBatch> g_frames;

void need_bus() {
  if (if_nametoindex("vcan0") == 0) _skip(__FILE__, __LINE__);
}
void open(CanSocket& can, bool fd, const CanFilter* filters = nullptr, int count = 0) {
  const Status status = can.open("vcan0", fd, filters, count, g_why);
  if (status != Status::kOk) print_error("%s\n", g_why.c_str());
  ASSERT_OK(status);
}
int receive(CanSocket& can) {
  assert_true(can.wait(1'000'000'000));
  return can.receive(g_frames.data(), CanSocket::kBatch);
}
CanFrame frame_of(std::uint16_t id, std::uint8_t size, bool fd = false) {
  CanFrame frame;
  frame.id = id;
  frame.size = size;
  frame.fd = fd;
  for (std::size_t i = 0; i < size; ++i) frame.data[i] = static_cast<std::uint8_t>(i + 1);
  return frame;
}
/// Sends a packet as it is.
void put(const can_frame& raw) {
  const int bare = ::socket(PF_CAN, SOCK_RAW, CAN_RAW);
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(if_nametoindex("vcan0"));
  const int bound = bind(bare, reinterpret_cast<const sockaddr*>(&address), sizeof address);
  const ssize_t sent = ::send(bare, &raw, sizeof raw, 0);
  ::close(bare);
  assert_int_equal(bound, 0);
  assert_int_equal(sent, sizeof raw);
}
/// Changes flags or MTU of vcan1, which only the tests of states use.
void change(unsigned long request, int value) {
  const int bare = ::socket(AF_INET, SOCK_DGRAM, 0);
  ifreq change{};
  std::strcpy(change.ifr_name, "vcan1");
  if (request == SIOCSIFMTU)
    change.ifr_mtu = value;
  else
    change.ifr_flags = static_cast<short>(value);
  const int done = ioctl(bare, request, &change);
  ::close(bare);
  assert_int_equal(done, 0);
}
void refused(const char* interface, bool fd, std::string_view reason) {
  ASSERT_STATUS(g_can.open(interface, fd, nullptr, 0, g_why), Status::kConnectionLost);
  if (reason != g_why) print_error("%s\n", g_why.c_str());
  assert_true(reason == g_why);
}

void frames_pass_between_two_sockets_in_order(void**) {
  need_bus();
  open(g_can, true);
  open(g_other, true);
  const std::array<CanFrame, 3> sent = {frame_of(0x201, 4), frame_of(0x202, 28, true),
                                        frame_of(0x080, 0)};
  assert_int_equal(static_cast<int>(g_can.send(sent.data(), 3)), static_cast<int>(Sent::kAll));
  assert_int_equal(receive(g_other), 3);
  assert_int_equal(g_frames[0].id, 0x201);
  assert_int_equal(g_frames[0].size, 4);
  assert_false(g_frames[0].fd);
  assert_int_equal(g_frames[1].id, 0x202);
  assert_int_equal(g_frames[1].size, 32);
  assert_true(g_frames[1].fd);
  assert_int_equal(g_frames[1].data[27], 28);
  assert_int_equal(g_frames[2].id, 0x080);
  assert_int_equal(g_can.receive(g_frames.data(), 3), 0);  // not its own frames
  assert_int_equal(g_can.health().error_frames, 0);
}

void frames_have_the_stamp_of_the_kernel(void**) {
  need_bus();
  open(g_can, false);
  open(g_other, false);
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  const CanFrame frame = frame_of(0x201, 4);
  assert_int_equal(static_cast<int>(g_can.send(&frame, 1)), static_cast<int>(Sent::kAll));
  assert_int_equal(receive(g_other), 1);
  const std::int64_t before_ns = now.tv_sec * std::int64_t{1'000'000'000} + now.tv_nsec;
  assert_true(g_frames[0].stamp_ns >= before_ns);
}

void filters_work_in_the_kernel(void**) {
  need_bus();
  constexpr std::array<CanFilter, 2> kFilters = {{{0x180, 0x780}, {0x081, 0x7FF}}};
  open(g_can, false, kFilters.data(), 2);
  open(g_other, false);
  for (const std::uint32_t id : {0x17FU, 0x180U, 0x1FFU, 0x200U, 0x081U, 0x181U | CAN_EFF_FLAG}) {
    can_frame raw{};
    raw.can_id = id;
    put(raw);
  }
  assert_int_equal(receive(g_can), 3);
  assert_int_equal(g_frames[1].id, 0x1FF);
  assert_int_equal(g_can.health().foreign, 0);
  assert_int_equal(receive(g_other), 5);
  assert_int_equal(g_other.health().foreign, 1);
}

void an_error_frame_becomes_health(void**) {
  need_bus();
  constexpr CanFilter kOnly = {0x181, 0x7FF};
  open(g_can, false, &kOnly, 1);
  can_frame raw{};
  raw.can_id = CAN_ERR_FLAG | CAN_ERR_BUSOFF;
  raw.can_dlc = CAN_ERR_DLC;
  put(raw);
  raw.can_id = CAN_ERR_FLAG | CAN_ERR_LOSTARB;  // not asked for
  put(raw);
  assert_int_equal(receive(g_can), 0);
  assert_true(g_can.health().bus_off);
  assert_int_equal(g_can.health().error_frames, 1);
}

void frames_that_found_no_room_are_counted(void**) {
  need_bus();
  open(g_can, false);
  open(g_other, false);
  constexpr int kFrames = 4096;
  std::array<CanFrame, CanSocket::kBatch> burst;
  burst.fill(frame_of(0x201, 8));
  for (int i = 0; i < kFrames; i += CanSocket::kBatch)
    assert_int_equal(static_cast<int>(g_can.send(burst.data(), CanSocket::kBatch)), 0);
  int received = 0;
  do received += g_other.receive(g_frames.data(), CanSocket::kBatch);
  while (g_other.may_have_more());
  assert_true(received >= 300);
  assert_true(received < kFrames);
  assert_int_equal(static_cast<int>(g_can.send(burst.data(), 1)), 0);  // brings the count
  assert_int_equal(receive(g_other), 1);
  assert_int_equal(received + static_cast<int>(g_other.health().dropped), kFrames);
}

void an_interface_that_goes_down_is_a_lost_link(void**) {
  need_bus();
  ASSERT_OK(g_can.open("vcan1", false, nullptr, 0, g_why));
  assert_false(g_can.health().lost);
  change(SIOCSIFFLAGS, 0);
  assert_int_equal(g_can.receive(g_frames.data(), 1), 0);
  assert_true(g_can.health().lost);
  refused("vcan1", false,
          "bus vcan1: the interface is down; set its bit rate and `ip link set` it up");
  change(SIOCSIFFLAGS, IFF_UP);
  ASSERT_OK(g_can.open("vcan1", false, nullptr, 0, g_why));
  change(SIOCSIFFLAGS, 0);
  const CanFrame frame = frame_of(0x201, 4);
  assert_int_equal(static_cast<int>(g_can.send(&frame, 1)), static_cast<int>(Sent::kLost));
  change(SIOCSIFFLAGS, IFF_UP);
}

void an_interface_without_can_fd_is_refused_for_it(void**) {
  need_bus();
  change(SIOCSIFFLAGS, 0);
  change(SIOCSIFMTU, 16);
  change(SIOCSIFFLAGS, IFF_UP);
  ASSERT_OK(g_can.open("vcan1", false, nullptr, 0, g_why));
  refused("vcan1", true, "bus vcan1: the interface is not set to CAN FD (its MTU is not 72)");
  change(SIOCSIFFLAGS, 0);
  change(SIOCSIFMTU, 72);
  change(SIOCSIFFLAGS, IFF_UP);
}

void an_interface_that_is_no_bus_is_named(void**) {
  need_bus();
  refused("vcan77", false, "bus vcan77: there is no such interface; `ip -brief link` lists them");
  refused("lo", false, "bus lo: not a CAN interface");
  refused("an_interface_with_a_long_name", false,
          "bus an_interface_with_a_long_name: the name is longer than an interface's can be");
}

}  // namespace
}  // namespace tactus::can

int main() {
  using namespace tactus::can;
  const CMUnitTest tests[] = {
      cmocka_unit_test(frames_pass_between_two_sockets_in_order),
      cmocka_unit_test(frames_have_the_stamp_of_the_kernel),
      cmocka_unit_test(filters_work_in_the_kernel),
      cmocka_unit_test(an_error_frame_becomes_health),
      cmocka_unit_test(frames_that_found_no_room_are_counted),
      cmocka_unit_test(an_interface_that_goes_down_is_a_lost_link),
      cmocka_unit_test(an_interface_without_can_fd_is_refused_for_it),
      cmocka_unit_test(an_interface_that_is_no_bus_is_named),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
