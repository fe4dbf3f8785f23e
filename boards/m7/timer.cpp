#include "boards/m7/timer.hpp"

#include "boards/m7/registers.hpp"

namespace m7 {
namespace {

constexpr std::uint32_t kTicksPerUs = kClockHz / 1'000'000, kNsPerTick = 1'000'000'000 / kClockHz;

std::uint32_t last_value;
std::int64_t time_ns;

}  // namespace

void set_period(std::uint32_t period_us) {
  at(kSystRvr) = kTicksPerUs * period_us - 1;
  at(kSystCvr) = 0;
}

void start_timer(std::uint32_t period_us) {
  at(kTimerReload) = at(kTimerValue) = last_value = 0xFFFFFFFF;
  at(kTimerCtrl) = 1;
  time_ns = 0;
  set_period(period_us);
  at(kSystCsr) = 7;  // the core's clock, an interrupt, on
}

std::int64_t now_ns() {
  const std::uint32_t value = at(kTimerValue);
  time_ns += std::int64_t{kNsPerTick} * static_cast<std::uint32_t>(last_value - value);
  last_value = value;
  return time_ns;
}

void start_watchdog() {
  at(kWatchdogLock) = kWatchdogKey;
  at(kWatchdogLoad) = kTicksPerUs * kWatchdog_us;
  at(kWatchdogControl) = 3;  // interrupt and reset
  at(kWatchdogLock) = 0;
}

void feed_watchdog() {
  at(kWatchdogLock) = kWatchdogKey;
  at(kWatchdogClear) = 1;
  at(kWatchdogLock) = 0;
}

}  // namespace m7
