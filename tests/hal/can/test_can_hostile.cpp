// Packets that are no frame of the bus: counted, dropped, and never read beyond.
#include <array>
#include <memory>

#include "tests/hal/can/can_pair.hpp"
#include "tests/support/testing.hpp"

namespace tactus::can {
namespace {

// A failed assertion is a longjmp, so the pair is not on the stack.
std::unique_ptr<CanPair> g_pair;
std::array<CanFrame, CanSocket::kBatch> g_frames;

CanPair& fresh(bool fd) {
  g_pair = std::make_unique<CanPair>(fd);
  return *g_pair;
}
int receive(CanPair& pair) {
  return pair.can.receive(g_frames.data(), static_cast<int>(g_frames.size()));
}

// Proves CAN-6.
void frames_with_29_bits_are_counted_and_dropped(void**) {
  CanPair& pair = fresh(false);
  assert_true(pair.put_frame(0x181 | CAN_EFF_FLAG, 8));
  assert_int_equal(receive(pair), 0);
  assert_int_equal(pair.can.health().foreign, 1);
  assert_int_equal(pair.can.health().malformed, 0);
}

void packets_that_are_no_frame_are_counted_and_dropped(void**) {
  CanPair& pair = fresh(true);
  std::array<std::uint8_t, 200> noise{};
  noise[0] = 1;
  std::uint32_t sent = 0;
  for (const std::size_t size : {0, 1, 4, 5, 8, 15, 17, 40, 71, 73, 144, 200}) {
    assert_true(pair.put(noise.data(), size));
    ++sent;
  }
  assert_true(pair.put_frame(0x181, 8));
  assert_int_equal(receive(pair), 1);
  assert_int_equal(g_frames[0].id, 0x181);
  assert_int_equal(pair.can.health().malformed, sent);
  assert_false(pair.can.health().lost);
}

void data_longer_than_a_frame_is_malformed(void**) {
  CanPair& pair = fresh(true);
  canfd_frame raw{};
  raw.can_id = 0x181;
  for (const int length : {9, 64, 255}) {
    raw.len = static_cast<std::uint8_t>(length);
    assert_true(pair.put(&raw, CAN_MTU));
  }
  for (const int length : {65, 255}) {
    raw.len = static_cast<std::uint8_t>(length);
    assert_true(pair.put(&raw, CANFD_MTU));
  }
  assert_int_equal(receive(pair), 0);
  assert_int_equal(pair.can.health().malformed, 5);
}

void a_classic_bus_takes_no_long_frames(void**) {
  CanPair& pair = fresh(false);
  canfd_frame raw{};
  raw.can_id = 0x181;
  raw.len = 8;
  assert_true(pair.put(&raw, CANFD_MTU));
  assert_int_equal(receive(pair), 0);
  assert_int_equal(pair.can.health().malformed, 1);
}

void every_length_but_two_is_malformed(void**) {
  for (const bool fd : {false, true}) {
    CanPair& pair = fresh(fd);
    std::array<std::uint8_t, 96> packet{};
    int frames = 0, packets = 0;
    for (std::size_t size = 0; size <= packet.size(); ++size, ++packets) {
      assert_true(pair.put(packet.data(), size));
      frames += receive(pair);
    }
    assert_int_equal(frames, fd ? 2 : 1);
    assert_int_equal(pair.can.health().malformed, packets - frames);
  }
}

}  // namespace
}  // namespace tactus::can

int main() {
  using namespace tactus::can;
  const CMUnitTest tests[] = {
      cmocka_unit_test(frames_with_29_bits_are_counted_and_dropped),
      cmocka_unit_test(packets_that_are_no_frame_are_counted_and_dropped),
      cmocka_unit_test(data_longer_than_a_frame_is_malformed),
      cmocka_unit_test(a_classic_bus_takes_no_long_frames),
      cmocka_unit_test(every_length_but_two_is_malformed),
  };
  const int failed = cmocka_run_group_tests(tests, nullptr, nullptr);
  g_pair.reset();
  return failed;
}
