// The program of a board with a Cortex-M7 and nothing else: the timer begins the cycles, messages
// are executed in what they leave of the time, and whatever hangs or faults ends with disabled
// drives, a record and a new start.
#include "boards/bare_metal/fault_record.hpp"
#include "boards/bare_metal/messages.hpp"
#include "boards/bare_metal/provoke.hpp"
#include "boards/bare_metal/semihosting.hpp"
#include "boards/bare_metal/semihosting_link.hpp"
#include "boards/bare_metal/timer.hpp"

namespace bare {
namespace {

using namespace tactus;

constexpr std::uint32_t kIdlePeriod_us = 1000;  // of the exchange, before a pipeline is loaded
/// Longest time for one message: a pipeline is loaded and a full store admitted in less.
constexpr std::uint32_t kLongestWork_us = 500'000;

SemihostingLink bytes;
serial::BoardLink board_link(bytes);
serial::SerialHal hal;
Messages messages(board_link, hal);
serial::CycleResult result;
std::atomic<std::uint32_t> pieces{0};  // of background work that ended
std::uint32_t seen_pieces = 0, unmoved_us = 0;
const Machine* last_machine = nullptr;  // whose cycles ran in the last period
int goodbyes = 0;                       // disabling frames that are still to be sent

/// Background work that does not come to an end is a fault as a cycle is that does not.
void watch_background(std::uint32_t period_us) {
  const std::uint32_t now = pieces.load(std::memory_order_relaxed);
  unmoved_us = now == seen_pieces ? unmoved_us + period_us : 0;
  seen_pieces = now;
  if (unmoved_us < kLongestWork_us) return;
  const std::uint32_t* frame;  // what the timer's interrupt has put on the stack of that work
  asm volatile("mrs %0, psp" : "=r"(frame));
  FaultRecord record;
  record.cause = FaultCause::kBackground;
  record.sp = static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(frame));
  record.lr = frame[5];
  record.pc = frame[6];
  end_with(record);
}

void run_cycle(Machine& machine) {
  CycleTime now = {now_ns()};
  if (messages.pace() == serial::Pace::kLockStep && !board_link.tick(now)) return;
  const ByteReader state = board_link.state();
  if (state.left() > 0) hal.take(state, now);
  provoked_cycle();
  machine.cycle(now, result);
  result.reports = messages.reports();
  board_link.send(result);
}

/// After the last cycle: a frame may be lost, so it is said more than once.
void disable_drives() {
  constexpr int kTimes = 10;
  if (last_machine != nullptr) goodbyes = kTimes;
  if (goodbyes == 0) return;
  --goodbyes;
  result.command.request = DriveRequest::kDisable;
  board_link.send(result);
}

/// What a period has to have time for. A function of its own, since its instructions are counted.
[[gnu::noinline]] void tick(Machine* machine) {
  board_link.poll();
  if (machine == nullptr) disable_drives();
  if (machine != last_machine) board_link.forget();  // what came before the start
  last_machine = machine;
  if (machine != nullptr) run_cycle(*machine);
  board_link.send_answer();
}

}  // namespace

std::uint32_t cycle_number() {
  return result.cycle;
}

void send_disable() {
  std::uint8_t nothing[1];
  result.command.request = DriveRequest::kDisable;
  board_link.send(result);
  bytes.receive(nothing, 0);
}

}  // namespace bare

extern "C" [[gnu::used]] void on_timer() {
  using namespace bare;
  clear_timer();
  Machine* const machine = messages.running();
  tick(machine);
  watch_background(machine != nullptr ? machine->period_us() : kIdlePeriod_us);
  feed_watchdog();
}

/// While there is nothing to do, a board in lock-step asks for its next tick, and one with a timer
/// of its own waits; it does not sleep, because QEMU 7.2 loses every second interrupt of a core
/// that does, by a clock that counts instructions.
extern "C" void program() {
  using namespace bare;
  if (!bytes.open()) semihosting::exit(2);
  start_watchdog();
  start_timer(kIdlePeriod_us);
  for (;;) {
    const bool worked = messages.work();
    pieces.fetch_add(1, std::memory_order_relaxed);
    if (!worked && messages.pace() == serial::Pace::kLockStep) call_timer();
  }
}
