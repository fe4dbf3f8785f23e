// Tests how CanHal leaves drives that follow: what it waits for, and which drives it releases.
#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "tests/sim_plant/drives/can_hal_bench.hpp"

namespace tactus::can {
namespace {

constexpr std::uint16_t kStopping = 0x0217, kEnabled = 0x1237, kDisabled = 0x0250;

CanHalBench& following(int buses, int stop_ms) {
  static std::optional<CanHalBench> bench;
  bench.emplace(buses);
  bench->drive.stop_ms = stop_ms;
  bench->can.heartbeat_ms = 500;  // a host that is late by a second loses no drive
  ASSERT_OK(bench->load());
  ASSERT_OK(bench->start());
  ASSERT_OK(bench->arm_drives());
  for (int i = 0; i < 10; ++i) ASSERT_OK(bench->cycle());
  bench->log.clear();
  bench->syncs = {};
  return *bench;
}
Status leave(CanHalBench& bench) {
  Status status = Status::kOk;
  bench.while_drives_answer([&] { status = bench.hal.disconnect(); });
  bench.exchange();  // what was sent last
  return status;
}
/// The watch of a drive over the master was ended, and the drive taken out of operation.
bool released(const CanHalBench& bench, int node) {
  bool unwatched = false, out = false;
  for (const CanFrame& frame : bench.log) {
    static constexpr std::uint8_t kNobody[] = {0x23, 0x16, 0x10, 0x01, 0, 0, 0, 0};
    unwatched |= frame.id == 0x600 + node && std::memcmp(frame.data.data(), kNobody, 8) == 0;
    out |= frame.id == 0 && frame.data[0] == 0x80 && frame.data[1] == node;
  }
  assert_true(unwatched == out);
  return out;
}
bool says(const CanHalBench& bench, const char* text) {
  const Message trouble = bench.hal.master().trouble();
  if (std::strstr(trouble.c_str(), text) != nullptr) return true;
  print_error("%s\n", trouble.c_str());
  return false;
}

// Proves CAN-15.
void every_drive_that_has_confirmed_is_released(void**) {
  CanHalBench& bench = following(3, 2000);
  ASSERT_OK(leave(bench));
  for (int node = 1; node <= kDof; ++node) assert_true(released(bench, node));
}

/// The queue of the interface holds no more.
void leaving_sends_no_more_frames_in_a_cycle_than_any_other(void**) {
  CanHalBench& bench = following(1, 2000);
  ASSERT_OK(leave(bench));
  int frames = 0;
  for (const CanFrame& frame : bench.log) {
    assert_in_range(++frames, 1, bench.hal.master().cycle_frames(0));
    if (frame.id == kSyncId) frames = 0;
  }
}

int frames_of_3 = 0;

/// A statusword in ten is not the drive's.
bool node_3_stays_enabled(CanFrame& answer) {
  if (answer.id == kTpdoBase[0] + 3)
    store(answer.data, 0, ++frames_of_3 % 10 == 0 ? kDisabled : kEnabled);
  return true;
}

void a_drive_that_does_not_confirm_is_named_and_keeps_its_watch(void**) {
  CanHalBench& bench = following(1, 1000);
  bench.passes = node_3_stays_enabled;
  ASSERT_STATUS(leave(bench), Status::kBusTimeout);
  assert_true(says(bench, "joint 3 (node 3): no statusword has confirmed within "));
  const Message trouble = bench.hal.master().trouble();
  assert_true(std::atoi(std::strstr(trouble.c_str(), "within ") + 7) >= 1000);
  assert_true(says(bench, " ms that the drive is disabled; its motor may have power: cut it by"));
  for (int node = 1; node <= kDof; ++node) assert_true(released(bench, node) == (node != 3));
}

bool node_3_is_silent(CanFrame& answer) {
  return (answer.id & kMaxNode) != 3;
}

/// It was given up as lost before, and cannot confirm: nothing is to be waited for but the time.
void a_drive_that_was_silent_before_is_waited_for_and_named(void**) {
  CanHalBench& bench = following(1, 700);
  bench.passes = node_3_is_silent;
  for (int i = 0; i < 2000; ++i) (void)bench.cycle();
  assert_true(bench.hal.master().lost(2) && !bench.executive.busy());
  ASSERT_STATUS(leave(bench), Status::kBusTimeout);
  assert_true(says(bench, "joint 3 (node 3): no statusword has confirmed within "));
  const Message trouble = bench.hal.master().trouble();
  assert_true(std::atoi(std::strstr(trouble.c_str(), "within ") + 7) >= 700);
  for (int node = 1; node <= kDof; ++node) assert_true(released(bench, node) == (node != 3));
}

bool node_3_is_heard_later(CanFrame& answer) {
  return (answer.id & kMaxNode) != 3 || ++frames_of_3 > 100;
}

/// Its cable is back some 100 cycles after the run has ended.
void a_drive_that_was_silent_and_is_heard_again_confirms(void**) {
  CanHalBench& bench = following(1, 30000);
  bench.passes = node_3_is_silent;
  for (int i = 0; i < 2000; ++i) (void)bench.cycle();
  frames_of_3 = 0;
  bench.passes = node_3_is_heard_later;
  ASSERT_OK(leave(bench));
}

int frames_while_stopping[kDof + 1];
constexpr int kSlow = 60;

/// The drives of the second and third bus take 60 cycles to stop.
bool drives_stop_slowly(CanFrame& answer) {
  const int node = answer.id - kTpdoBase[0];
  if (node >= 4 && node <= kDof && ++frames_while_stopping[node] <= kSlow)
    store(answer.data, 0, kStopping);
  return true;
}

void drives_on_the_buses_that_work_are_taken_to_their_stop_without_the_others(void**) {
  CanHalBench& bench = following(3, 2000);
  std::fill_n(frames_while_stopping, kDof + 1, 0);
  bench.passes = drives_stop_slowly;
  bench.ends[0].reset();
  ASSERT_STATUS(bench.cycle(), Status::kConnectionLost);
  ASSERT_STATUS(leave(bench), Status::kBusTimeout);
  assert_true(says(bench, "joint 1 (node 1), joint 2 (node 2), joint 3 (node 3): no statusword"));
  for (std::size_t bus = 1; bus < 3; ++bus) assert_true(bench.syncs[bus] > kSlow);
  for (int node = 4; node <= kDof; ++node) assert_true(released(bench, node));
}

/// Nothing can be heard any more, and no time is said to have been waited for.
void drives_on_a_bus_that_has_failed_are_named_at_once(void**) {
  CanHalBench& bench = following(1, 2000);
  bench.ends[0].reset();
  ASSERT_STATUS(bench.cycle(), Status::kConnectionLost);
  ASSERT_STATUS(leave(bench), Status::kBusTimeout);
  assert_true(says(bench, "joint 7 (node 7): no statusword has confirmed that the drive is"));
}

}  // namespace
}  // namespace tactus::can

int main() {
  using namespace tactus::can;
  const CMUnitTest tests[] = {
      cmocka_unit_test(every_drive_that_has_confirmed_is_released),
      cmocka_unit_test(leaving_sends_no_more_frames_in_a_cycle_than_any_other),
      cmocka_unit_test(a_drive_that_does_not_confirm_is_named_and_keeps_its_watch),
      cmocka_unit_test(a_drive_that_was_silent_before_is_waited_for_and_named),
      cmocka_unit_test(a_drive_that_was_silent_and_is_heard_again_confirms),
      cmocka_unit_test(drives_on_the_buses_that_work_are_taken_to_their_stop_without_the_others),
      cmocka_unit_test(drives_on_a_bus_that_has_failed_are_named_at_once),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
