#include "boards/bare_metal/timer.hpp"

#include "boards/bare_metal/apb_watchdog.hpp"
#include "boards/m55/registers.hpp"

namespace bare {
namespace {

constexpr std::uint32_t kTicksPerUs = kClockHz / 1'000'000;
constexpr ApbWatchdog kApbWatchdog = {kWatchdog};

std::uint32_t period_ticks;
std::int64_t start_ticks, next_interrupt;

/// The high half first: the comparator is never below both values.
void compare_with(std::int64_t count) {
  next_interrupt = count;
  at(kTimer + kCompareHigh) = static_cast<std::uint32_t>(count >> 32);
  at(kTimer + kCompare) = static_cast<std::uint32_t>(count);
}

/// The high half changes every 134 s, so it has changed once at most between the reads.
std::int64_t now_ticks() {
  const std::uint32_t high = at(kTimer + kCountHigh), low = at(kTimer + kCount);
  const std::uint32_t later = at(kTimer + kCountHigh);
  return std::int64_t{later} << 32 | (later == high ? low : at(kTimer + kCount));
}

}  // namespace

/// A tick is 31.25 ns. QEMU 7.2 waits for ever for one that is not at a whole ns, by a clock that
/// counts instructions, so the comparator gets only multiples of four.
void set_period(std::uint32_t period_us) {
  asm volatile("cpsid i" ::: "memory");  // the interrupt changes the comparator, too
  period_ticks = kTicksPerUs * period_us;
  compare_with((now_ticks() & ~std::int64_t{3}) + period_ticks);
  asm volatile("cpsie i" ::: "memory");
}

void start_timer(std::uint32_t period_us) {
  at(kCounterControl) = kEnabled;
  start_ticks = now_ticks();
  set_period(period_us);
  at(kTimer + kControl) = kEnabled;
  at(kNvicIser) = 1U << kTimerIrq;
}

void call_timer() {
  at(kNvicIspr) = 1U << kTimerIrq;
  asm volatile("dsb\n isb");
}

/// Nothing, if another than the timer has called. Periods that are over are skipped.
void clear_timer() {
  const std::int64_t late = now_ticks() - next_interrupt;
  if (late >= 0) compare_with(next_interrupt + (late / period_ticks + 1) * period_ticks);
}

std::int64_t now_ns() {
  return (now_ticks() - start_ticks) * 1000 / kTicksPerUs;
}

void start_watchdog() {
  kApbWatchdog.start(std::uint64_t{kWatchdogHz} * kWatchdog_us / 1'000'000);
}

void feed_watchdog() {
  kApbWatchdog.feed();
}

}  // namespace bare
