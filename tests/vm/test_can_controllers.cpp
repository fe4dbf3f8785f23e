// A CanSocket on an emulated Kvaser controller with its real driver, can0; a second one, can1, is
// on the same bus.
#include <sched.h>

#include <array>
#include <memory>
#include <utility>

#include "tests/support/testing.hpp"
#include "tests/vm/can_bus.hpp"

namespace tactus::can {
namespace {

constexpr const char *kOwn = "can0", *kOthers = "can1";

std::unique_ptr<CanBus> g_bus;
std::array<CanFrame, CanSocket::kBatch> g_batch;

CanBus& fresh() {
  if (if_nametoindex(kOwn) == 0) _skip(__FILE__, __LINE__);
  g_bus = std::make_unique<CanBus>(kOwn, kOthers);
  ASSERT_OK(g_bus->status);
  for (std::size_t i = 0; i < g_batch.size(); ++i) {
    g_batch[i] = CanFrame();
    g_batch[i].id = static_cast<std::uint16_t>(0x200 + i);
    g_batch[i].size = 1;
    g_batch[i].data[0] = static_cast<std::uint8_t>(i);
  }
  return *g_bus;
}

// Proves CAN-8.
void frames_of_a_batch_reach_the_other_controller_in_order(void**) {
  CanBus& bus = fresh();
  assert_int_equal(static_cast<int>(bus.can.send(g_batch.data(), CanSocket::kBatch)), 0);
  canfd_frame raw{};
  for (std::uint32_t i = 0; i < CanSocket::kBatch; ++i) {
    assert_int_equal(bus.take(raw), CAN_MTU);
    assert_int_equal(raw.can_id, 0x200 + i);
    assert_int_equal(raw.data[0], i);
  }
  assert_int_equal(bus.can.health().unsent, 0);
}

void frames_of_the_other_controller_are_received_with_a_stamp(void**) {
  CanBus& bus = fresh();
  for (std::uint8_t i = 0; i < 8; ++i) assert_true(bus.put_frame(0x181U + i, i));
  int got = 0;
  while (got < 8 && bus.can.wait(1'000'000'000) == WaitResult::kSomething)
    got += bus.can.receive(&g_batch[0] + got, 8 - got);
  assert_int_equal(got, 8);
  for (std::size_t i = 0; i < 8; ++i) {
    assert_int_equal(g_batch[i].id, 0x181 + i);
    assert_true(g_batch[i].stamp_ns > 0);
  }
  assert_int_equal(bus.can.health().error_frames, 0);
}

/// Sets the priority of this thread above or, with 0, back below that of the controllers' interrupt
/// threads, which is 50.
bool set_priority(int priority) {
  const sched_param how = {priority};
  return sched_setscheduler(0, priority > 0 ? SCHED_FIFO : SCHED_OTHER, &how) == 0;
}

/// Sends while no interrupt thread runs, so that the queue of a single processor fills.
template <class Send>
auto with_full_queue(int frames, Send send) {
  assert_true(set_queue(kOwn, frames));
  assert_true(set_priority(80));
  const auto result = send();
  assert_true(set_priority(0));
  assert_true(set_queue(kOwn, 1000));
  return result;
}

void a_full_queue_of_the_interface_refuses_a_frame_with_ENOBUFS(void**) {
  CanBus& bus = fresh();
  const CanBus others(kOthers, kOwn);
  const int error = with_full_queue(10, [&others] {
    for (std::uint32_t i = 0; i < CanSocket::kBatch; ++i)
      if (!others.put_frame(0x300 + i)) return errno;
    return 0;
  });
  assert_int_equal(error, ENOBUFS);
  assert_false(bus.can.health().lost);
}

void a_full_queue_is_told_and_what_was_taken_is_sent(void**) {
  CanBus& bus = fresh();
  const auto [sent, again] = with_full_queue(10, [&bus] {
    const Sent first = bus.can.send(g_batch.data(), CanSocket::kBatch);
    return std::pair(first, bus.can.send(g_batch.data(), 1));
  });
  assert_int_equal(static_cast<int>(sent), static_cast<int>(Sent::kQueueFull));
  assert_int_equal(static_cast<int>(again), static_cast<int>(Sent::kQueueFull));
  assert_false(bus.can.health().lost);
  const int taken = CanSocket::kBatch + 1 - static_cast<int>(bus.can.health().unsent);
  assert_in_range(taken, 10, 20);
  canfd_frame raw{};
  for (int i = 0; i < taken; ++i) assert_int_equal(bus.take(raw), CAN_MTU);
  assert_int_equal(raw.can_id, 0x200 + taken - 1);
  assert_int_equal(static_cast<int>(bus.can.send(g_batch.data(), 1)), static_cast<int>(Sent::kAll));
}

void the_length_of_the_queue_is_known(void**) {
  assert_int_equal(fresh().can.queue_frames(), 1000);
}

void a_classic_controller_is_refused_for_CAN_FD(void**) {
  if (if_nametoindex(kOwn) == 0) _skip(__FILE__, __LINE__);
  g_bus = std::make_unique<CanBus>(kOwn, kOthers, true);
  ASSERT_STATUS(g_bus->status, Status::kConnectionLost);
  assert_non_null(std::strstr(g_bus->why.c_str(), "not set to CAN FD"));
}

void a_controller_that_goes_down_is_a_lost_link(void**) {
  CanBus& bus = fresh();
  assert_true(set_up(kOwn, false));
  assert_int_equal(bus.can.receive(g_batch.data(), CanSocket::kBatch), 0);
  assert_true(set_up(kOwn, true));
  assert_true(bus.can.health().lost);
  ASSERT_OK(bus.can.open(kOwn, false, nullptr, 0, bus.why));
  assert_int_equal(static_cast<int>(bus.can.send(g_batch.data(), 1)), static_cast<int>(Sent::kAll));
  canfd_frame raw{};
  assert_int_equal(bus.take(raw), CAN_MTU);
}

}  // namespace
}  // namespace tactus::can

int main() {
  using namespace tactus::can;
  const CMUnitTest tests[] = {
      cmocka_unit_test(frames_of_a_batch_reach_the_other_controller_in_order),
      cmocka_unit_test(frames_of_the_other_controller_are_received_with_a_stamp),
      cmocka_unit_test(a_full_queue_of_the_interface_refuses_a_frame_with_ENOBUFS),
      cmocka_unit_test(a_full_queue_is_told_and_what_was_taken_is_sent),
      cmocka_unit_test(the_length_of_the_queue_is_known),
      cmocka_unit_test(a_classic_controller_is_refused_for_CAN_FD),
      cmocka_unit_test(a_controller_that_goes_down_is_a_lost_link),
  };
  const int failed = cmocka_run_group_tests(tests, nullptr, nullptr);
  g_bus.reset();
  return failed;
}
