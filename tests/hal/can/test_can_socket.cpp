// Frames through a CanSocket at one end of a packet socket pair.
#include <array>
#include <ctime>
#include <memory>

#include "tests/hal/can/can_pair.hpp"
#include "tests/support/testing.hpp"

namespace tactus::can {
namespace {

// A failed assertion is a longjmp, so the pair is not on the stack.
std::unique_ptr<CanPair> g_pair;
std::array<CanFrame, CanSocket::kBatch + 8> g_frames;

CanPair& fresh(bool fd = false, const CanFilter* filters = nullptr, int count = 0) {
  g_pair = std::make_unique<CanPair>(fd, filters, count);
  return *g_pair;
}
int receive(CanPair& pair) {
  return pair.can.receive(g_frames.data(), static_cast<int>(g_frames.size()));
}
CanFrame frame_of(std::uint16_t id, std::uint8_t size, bool fd = false) {
  CanFrame frame;
  frame.id = id;
  frame.size = size;
  frame.fd = fd;
  for (std::size_t i = 0; i < size; ++i) frame.data[i] = static_cast<std::uint8_t>(i + 1);
  return frame;
}

// Proves CAN-6.
void a_classic_frame_is_the_16_bytes_of_linux(void**) {
  const CanPair& pair = fresh();
  const CanFrame frame = frame_of(0x201, 4);
  assert_int_equal(static_cast<int>(g_pair->can.send(&frame, 1)), static_cast<int>(Sent::kAll));
  std::array<std::uint8_t, 80> packet{};
  assert_int_equal(pair.take(packet.data(), packet.size()), 16);
  constexpr std::array<std::uint8_t, 16> kExpected = {0x01, 0x02, 0, 0, 4, 0, 0, 0, 1, 2, 3, 4};
  assert_memory_equal(packet.data(), kExpected.data(), kExpected.size());
}

void data_of_a_long_frame_is_padded_to_a_length_that_exists(void**) {
  const CanPair& pair = fresh(true);
  const CanFrame frame = frame_of(0x201, 28, true);
  assert_int_equal(static_cast<int>(g_pair->can.send(&frame, 1)), static_cast<int>(Sent::kAll));
  std::array<std::uint8_t, 80> packet{};
  assert_int_equal(pair.take(packet.data(), packet.size()), 72);
  assert_int_equal(packet[4], 32);
  assert_int_equal(packet[5] & CANFD_BRS, CANFD_BRS);
  assert_int_equal(packet[8 + 27], 28);
  for (std::size_t i = 8 + 28; i < 72; ++i) assert_int_equal(packet[i], 0);
}

void frames_come_in_order_with_their_data(void**) {
  CanPair& pair = fresh(true);
  assert_true(pair.put_frame(0x181, 8));
  canfd_frame raw{};
  raw.can_id = 0x182;
  raw.len = 12;
  raw.data[11] = 0xAB;
  assert_true(pair.put(&raw, sizeof raw));
  assert_int_equal(receive(pair), 2);
  assert_int_equal(g_frames[0].id, 0x181);
  assert_int_equal(g_frames[0].size, 8);
  assert_false(g_frames[0].fd);
  assert_int_equal(g_frames[0].data[7], 0x81);
  assert_int_equal(g_frames[1].id, 0x182);
  assert_int_equal(g_frames[1].size, 12);
  assert_true(g_frames[1].fd);
  assert_int_equal(g_frames[1].data[11], 0xAB);
}

void bytes_beyond_the_data_are_zero(void**) {
  CanPair& pair = fresh();
  assert_true(pair.put_frame(0x1FF, 3));
  assert_int_equal(receive(pair), 1);
  assert_int_equal(g_frames[0].data[2], 0xFF);
  for (std::size_t i = 3; i < kMaxData; ++i) assert_int_equal(g_frames[0].data[i], 0);
}

std::int64_t real_time_ns() {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  return now.tv_sec * std::int64_t{1'000'000'000} + now.tv_nsec;
}
void each_frame_has_the_stamp_of_the_kernel(void**) {
  CanPair& pair = fresh();
  const std::int64_t before_ns = real_time_ns();
  assert_true(pair.put_frame(0x181, 8));
  assert_int_equal(receive(pair), 1);
  assert_true(g_frames[0].stamp_ns >= before_ns);
  assert_true(g_frames[0].stamp_ns <= real_time_ns());
}

void a_remote_request_has_no_data(void**) {
  CanPair& pair = fresh();
  assert_true(pair.put_frame(0x701 | CAN_RTR_FLAG, 8));
  assert_int_equal(receive(pair), 1);
  assert_true(g_frames[0].remote);
  assert_int_equal(g_frames[0].size, 0);
  assert_int_equal(g_frames[0].data[0], 0);
}

void frames_that_no_filter_names_are_not_received(void**) {
  constexpr std::array<CanFilter, 2> kFilters = {{{0x180, 0x780}, {0x081, 0x7FF}}};
  CanPair& pair = fresh(false, kFilters.data(), 2);
  for (const std::uint32_t id : {0x17FU, 0x180U, 0x1FFU, 0x200U, 0x080U, 0x081U})
    assert_true(pair.put_frame(id, 1));
  assert_int_equal(receive(pair), 3);
  assert_int_equal(g_frames[0].id, 0x180);
  assert_int_equal(g_frames[1].id, 0x1FF);
  assert_int_equal(g_frames[2].id, 0x081);
}

void a_burst_longer_than_a_batch_comes_in_two_calls(void**) {
  CanPair& pair = fresh();
  for (std::uint32_t i = 0; i < CanSocket::kBatch + 2; ++i) assert_true(pair.put_frame(i, 1));
  assert_int_equal(receive(pair), CanSocket::kBatch);
  assert_int_equal(receive(pair), 2);
  assert_int_equal(g_frames[1].id, CanSocket::kBatch + 1);
}

void no_more_frames_are_taken_than_there_is_room_for(void**) {
  CanPair& pair = fresh();
  for (std::uint32_t i = 0; i < 5; ++i) assert_true(pair.put_frame(i, 1));
  assert_int_equal(pair.can.receive(g_frames.data(), 0), 0);
  assert_int_equal(pair.can.receive(g_frames.data(), 3), 3);
  assert_int_equal(receive(pair), 2);
  assert_int_equal(g_frames[0].id, 3);
}

void a_cycle_is_one_system_call_in_each_direction(void**) {
  CanPair& pair = fresh();
  std::array<CanFrame, 8> commands;
  commands.fill(frame_of(0x201, 4));
  for (int cycle = 0; cycle < 10; ++cycle) {
    for (std::uint32_t i = 0; i < 7; ++i) assert_true(pair.put_frame(0x181 + i, 8));
    assert_int_equal(receive(pair), 7);
    assert_int_equal(static_cast<int>(pair.can.send(commands.data(), 8)), 0);
    can_frame raw{};
    for (int i = 0; i < 8; ++i) assert_int_equal(pair.take(&raw, sizeof raw), 16);
  }
  assert_int_equal(pair.can.system_calls(), 20);
}

void an_empty_bus_is_no_fault(void**) {
  CanPair& pair = fresh();
  assert_int_equal(receive(pair), 0);
  assert_true(pair.can.wait(0) == WaitResult::kNothing);
  assert_false(pair.can.health().lost);
}

void a_peer_that_closes_is_a_lost_link(void**) {
  CanPair& pair = fresh();
  assert_true(pair.put_frame(0x181, 8));
  pair.hang_up();
  assert_int_equal(receive(pair), 1);
  assert_true(pair.can.health().lost);
  assert_int_equal(pair.can.health().malformed, 0);
  const int calls = pair.can.system_calls();
  const CanFrame frame = frame_of(0x201, 4);
  assert_int_equal(static_cast<int>(pair.can.send(&frame, 1)), static_cast<int>(Sent::kLost));
  assert_int_equal(pair.can.system_calls(), calls);
}

void sending_to_a_closed_peer_loses_the_link(void**) {
  CanPair& pair = fresh();
  pair.hang_up();
  const CanFrame frame = frame_of(0x201, 4);
  assert_int_equal(static_cast<int>(pair.can.send(&frame, 1)), static_cast<int>(Sent::kLost));
  assert_true(pair.can.health().lost);
  assert_int_equal(pair.can.health().unsent, 1);
}

void a_full_queue_is_told_and_counted(void**) {
  CanPair& pair = fresh();
  std::array<CanFrame, CanSocket::kBatch> commands;
  commands.fill(frame_of(0x201, 4));
  Sent sent = Sent::kAll;
  int calls = 0;
  while (sent == Sent::kAll && ++calls < 10000)
    sent = pair.can.send(commands.data(), CanSocket::kBatch);
  assert_int_equal(static_cast<int>(sent), static_cast<int>(Sent::kQueueFull));
  assert_false(pair.can.health().lost);
  int arrived = 0;
  can_frame raw{};
  while (pair.take(&raw, sizeof raw) == 16) ++arrived;
  assert_int_equal(arrived + static_cast<int>(pair.can.health().unsent), calls * CanSocket::kBatch);
  assert_int_equal(static_cast<int>(pair.can.send(commands.data(), 1)), 0);
}

}  // namespace
}  // namespace tactus::can

int main() {
  using namespace tactus::can;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_classic_frame_is_the_16_bytes_of_linux),
      cmocka_unit_test(data_of_a_long_frame_is_padded_to_a_length_that_exists),
      cmocka_unit_test(frames_come_in_order_with_their_data),
      cmocka_unit_test(bytes_beyond_the_data_are_zero),
      cmocka_unit_test(each_frame_has_the_stamp_of_the_kernel),
      cmocka_unit_test(a_remote_request_has_no_data),
      cmocka_unit_test(frames_that_no_filter_names_are_not_received),
      cmocka_unit_test(a_burst_longer_than_a_batch_comes_in_two_calls),
      cmocka_unit_test(no_more_frames_are_taken_than_there_is_room_for),
      cmocka_unit_test(a_cycle_is_one_system_call_in_each_direction),
      cmocka_unit_test(an_empty_bus_is_no_fault),
      cmocka_unit_test(a_peer_that_closes_is_a_lost_link),
      cmocka_unit_test(sending_to_a_closed_peer_loses_the_link),
      cmocka_unit_test(a_full_queue_is_told_and_counted),
  };
  const int failed = cmocka_run_group_tests(tests, nullptr, nullptr);
  g_pair.reset();
  return failed;
}
