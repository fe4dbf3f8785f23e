#include "boards/bare_metal/timer.hpp"

#include "boards/bare_metal/apb_watchdog.hpp"
#include "boards/m7/registers.hpp"

namespace bare {
namespace {

constexpr std::uint32_t kTicksPerUs = kClockHz / 1'000'000, kNsPerTick = 1'000'000'000 / kClockHz;

constexpr ApbWatchdog kApbWatchdog = {kWatchdog};

std::uint32_t last_value;
std::int64_t time_ns;

}  // namespace

void set_period(std::uint32_t period_us) {
  at(kTimer + kReload) = at(kTimer + kValue) = kTicksPerUs * period_us - 1;
}

void start_timer(std::uint32_t period_us) {
  at(kClock + kReload) = at(kClock + kValue) = last_value = 0xFFFFFFFF;
  at(kClock + kCtrl) = kEnabled;
  time_ns = 0;
  set_period(period_us);
  at(kTimer + kCtrl) = kEnabled | kInterrupts;
  at(kNvicIser) = 1U << kTimerIrq;
}

void call_timer() {
  at(kNvicIspr) = 1U << kTimerIrq;
  asm volatile("dsb\n isb");
}

void clear_timer() {
  at(kTimer + kIntClear) = 1;
}

std::int64_t now_ns() {
  const std::uint32_t value = at(kClock + kValue);
  time_ns += std::int64_t{kNsPerTick} * static_cast<std::uint32_t>(last_value - value);
  last_value = value;
  return time_ns;
}

void start_watchdog() {
  kApbWatchdog.start(kTicksPerUs * kWatchdog_us);
}

void feed_watchdog() {
  kApbWatchdog.feed();
}

}  // namespace bare
