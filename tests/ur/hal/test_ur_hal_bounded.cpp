// What a cycle with a UR's HAL asks of the operating system: never to wait, and little of the rest,
// whatever the controller leaves unanswered. The calls of the C library are replaced by ones that
// are counted.
#include <sys/syscall.h>

#include <cerrno>

#include "tests/ur/hal/ur_exchange_bench.hpp"

namespace {

struct Calls {
  int waits = 0, transfers = 0;
};
thread_local bool counting = false;
Calls calls;
std::size_t longest_part = 65536;  // of a program that the network takes at once

}  // namespace

extern "C" int ppoll(pollfd* polled, nfds_t count, const timespec* timeout, const sigset_t*) {
  if (counting) ++calls.waits;
  timespec left = timeout == nullptr ? timespec{} : *timeout;
  return static_cast<int>(
      syscall(SYS_ppoll, polled, count, timeout == nullptr ? nullptr : &left, nullptr, 0));
}
extern "C" ssize_t recv(int socket, void* data, std::size_t size, int flags) {
  if (counting) ++calls.transfers;
  return syscall(SYS_recvfrom, socket, data, size, flags, nullptr, nullptr);
}
extern "C" ssize_t send(int socket, const void* data, std::size_t size, int flags) {
  if (counting) ++calls.transfers;
  constexpr std::size_t kLongestPacket = 512;  // what is longer is a program
  const bool cuts = counting && size > kLongestPacket;
  if (cuts && longest_part == 0) {
    errno = EAGAIN;
    return -1;
  }
  return syscall(SYS_sendto, socket, data, cuts ? std::min(size, longest_part) : size, flags,
                 nullptr, 0);
}

namespace tactus::ur {
namespace {

/// Reads and writes without waiting for packets; the calls of the worst cycle.
Calls worst_of(UrExchange& bench, int cycles, DriveRequest request) {
  Calls worst;
  for (int i = 0; i < cycles; ++i) {
    calls = {};
    counting = true;
    const Status read = bench.hal.read(bench.now, bench.state);
    const Status written = bench.hal.write({CommandMode::kPosition, bench.state.q, request});
    counting = false;
    ASSERT_OK(read);
    ASSERT_OK(written);
    worst.waits = std::max(worst.waits, calls.waits);
    worst.transfers = std::max(worst.transfers, calls.transfers);
  }
  return worst;
}

// Proves URH-29.

void a_call_that_waits_is_counted(void**) {
  const Socket socket;
  calls = {};
  counting = true;
  socket.wait(0);
  counting = false;
  assert_int_equal(calls.waits, 1);
}

/// In every phase whose end is up to the robot, for as long as it may last.
void a_controller_that_answers_nothing_is_not_waited_for(void**) {
  for (const DrivePhase phase :
       {DrivePhase::kReleaseStop, DrivePhase::kPowerOn, DrivePhase::kRegister, DrivePhase::kUpload,
        DrivePhase::kProgram, DrivePhase::kFirstSetPoint, DrivePhase::kEnabled,
        DrivePhase::kStopping}) {
    UrExchange& bench = g_exchange.emplace();
    bench.settings.power_ms = bench.settings.program_ms = 60000;
    bench.settings.max_missed = 100;
    bench.stop_robot();
    if (phase != DrivePhase::kReleaseStop) bench.robot.image.safety_mode = 1;
    bench.robot.image.safety_bits = 0;
    bench.open();
    const bool stops = phase == DrivePhase::kStopping;
    bench.exchange_until(DriveRequest::kArm, stops ? DrivePhase::kEnabled : phase);
    bench.robot.faults.silent_dashboard = true;
    longest_part = 0;
    const Calls worst = worst_of(bench, 1000, stops ? DriveRequest::kDisable : DriveRequest::kArm);
    longest_part = 65536;
    assert_string_equal(name(bench.hal.phase()), name(phase));
    assert_int_equal(worst.waits, 0);
    assert_in_range(worst.transfers, 1, 4);
  }
}

/// The network takes a program in pieces; a request to stop does not cut it off.
void an_upload_goes_on_over_cycles(void**) {
  for (const DriveRequest request : {DriveRequest::kArm, DriveRequest::kDisable}) {
    UrExchange& bench = g_exchange.emplace();
    bench.open();
    bench.exchange_until(DriveRequest::kArm, DrivePhase::kUpload);
    longest_part = 100;
    counting = true;
    bench.exchange(DriveRequest::kArm);
    bench.exchange(DriveRequest::kArm);
    assert_int_equal(bench.robot.uploads(), 0);
    const bool stops = request == DriveRequest::kDisable;
    for (int i = 0; i < 60; ++i) bench.exchange(request);
    counting = false;
    longest_part = 65536;
    assert_int_equal(bench.robot.uploads(), 1);
    assert_int_equal(bench.robot.ends(), stops ? 1 : 0);
    assert_string_equal(name(bench.state.drives[0].state),
                        name(stops ? DriveState::kDisabled : DriveState::kEnabled));
    assert_int_equal(bench.runtime_state(), stops ? 1 : 2);
  }
}

}  // namespace
}  // namespace tactus::ur

int main() {
  using namespace tactus::ur;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_call_that_waits_is_counted),
      cmocka_unit_test(a_controller_that_answers_nothing_is_not_waited_for),
      cmocka_unit_test(an_upload_goes_on_over_cycles),
  };
  return cmocka_run_group_tests(tests, nullptr, end_exchange);
}
