// What heartbeats tell about a node.
#include "hal/can/heartbeat_watch.hpp"
#include "tests/support/testing.hpp"

namespace tactus::can {
namespace {

constexpr std::int64_t kMs_ns = 1'000'000;

CanFrame message(std::uint16_t id, std::uint8_t byte) {
  CanFrame frame;
  frame.id = id;
  frame.size = 1;
  frame.data[0] = byte;
  return frame;
}
HeartbeatWatch watch_of(std::uint8_t node) {
  HeartbeatWatch watch;
  watch.start(node, 50 * kMs_ns, 1000 * kMs_ns);
  return watch;
}

// Proves CAN-7.
void each_heartbeat_tells_the_state(void**) {
  HeartbeatWatch watch = watch_of(5);
  assert_false(watch.known());
  constexpr std::uint8_t kStates[] = {0x00, 0x7F, 0x05, 0x04};
  for (const std::uint8_t byte : kStates) {
    assert_true(watch.receive(message(0x705, byte), 1001 * kMs_ns));
    assert_true(watch.known());
    assert_int_equal(static_cast<std::uint8_t>(watch.state()), byte);
  }
  assert_int_equal(watch.boot_ups(), 1);
}

void silence_is_a_lost_node_after_its_time(void**) {
  HeartbeatWatch watch = watch_of(5);
  assert_false(watch.is_lost(1050 * kMs_ns - 1));
  assert_true(watch.is_lost(1050 * kMs_ns));
  assert_true(watch.receive(message(0x705, 0x05), 1030 * kMs_ns));
  assert_false(watch.is_lost(1080 * kMs_ns - 1));
  assert_true(watch.is_lost(1080 * kMs_ns));
  assert_int_equal(watch.heard_ns(), 1030 * kMs_ns);
}

void a_node_that_is_not_watched_is_not_lost(void**) {
  HeartbeatWatch watch;
  assert_false(watch.is_lost(INT64_MAX));
  assert_false(watch.receive(message(0x700, 0x05), 0));
}

void other_frames_prove_nothing(void**) {
  HeartbeatWatch watch = watch_of(5);
  CanFrame remote = message(0x705, 0x05);
  remote.remote = true;
  for (const CanFrame& frame : {message(0x706, 0x05), message(0x605, 0x05), remote})
    assert_false(watch.receive(frame, 1040 * kMs_ns));
  assert_int_equal(watch.malformed(), 0);
  assert_true(watch.is_lost(1050 * kMs_ns));
}

void a_state_that_does_not_exist_proves_nothing(void**) {
  HeartbeatWatch watch = watch_of(5);
  CanFrame two = message(0x705, 0x05), none = two;
  two.size = 2;
  none.size = 0;
  for (const CanFrame& frame : {message(0x705, 0x01), message(0x705, 0x85), two, none})
    assert_false(watch.receive(frame, 1040 * kMs_ns));
  assert_int_equal(watch.malformed(), 4);
  assert_false(watch.known());
  assert_true(watch.is_lost(1050 * kMs_ns));
}

void a_node_that_restarts_by_itself_shows_by_a_boot_up(void**) {
  HeartbeatWatch watch = watch_of(5);
  constexpr std::uint8_t kStates[] = {0x00, 0x05, 0x00, 0x7F};
  for (const std::uint8_t byte : kStates)
    assert_true(watch.receive(message(0x705, byte), 1001 * kMs_ns));
  assert_int_equal(watch.boot_ups(), 2);
}

void a_new_start_forgets_the_node(void**) {
  HeartbeatWatch watch = watch_of(5);
  assert_true(watch.receive(message(0x705, 0x00), 1001 * kMs_ns));
  watch.start(6, 50 * kMs_ns, 2000 * kMs_ns);
  assert_int_equal(watch.boot_ups(), 0);
  assert_false(watch.known());
  assert_false(watch.receive(message(0x705, 0x05), 2001 * kMs_ns));
  assert_false(watch.is_lost(2050 * kMs_ns - 1));
}

}  // namespace
}  // namespace tactus::can

int main() {
  using namespace tactus::can;
  const CMUnitTest tests[] = {
      cmocka_unit_test(each_heartbeat_tells_the_state),
      cmocka_unit_test(silence_is_a_lost_node_after_its_time),
      cmocka_unit_test(a_node_that_is_not_watched_is_not_lost),
      cmocka_unit_test(other_frames_prove_nothing),
      cmocka_unit_test(a_state_that_does_not_exist_proves_nothing),
      cmocka_unit_test(a_node_that_restarts_by_itself_shows_by_a_boot_up),
      cmocka_unit_test(a_new_start_forgets_the_node),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
