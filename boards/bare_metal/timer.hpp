// The timers of the board: one begins the cycles, one tells the time, one ends a program that
// hangs.
#pragma once

#include <cstdint>

namespace bare {

/// Begins to call on_timer() every period. The clock starts at 0. [init]
void start_timer(std::uint32_t period_us);
/// Changes the period. [init, not cyclic]
void set_period(std::uint32_t period_us);
/// Has on_timer() called at once. [background]
void call_timer();
/// The interrupt that called on_timer() was heard. [cyclic]
void clear_timer();
/// The time since the start, ns; asked at least every 100 s. [cyclic]
std::int64_t now_ns();

/// From now on the watchdog expects to be fed: every kWatchdog_us at the latest. [init]
void start_watchdog();
void feed_watchdog();
inline constexpr std::uint32_t kWatchdog_us = 50'000;

}  // namespace bare
