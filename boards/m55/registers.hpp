// Registers of the machine's system counter, timers and watchdog [Arm, Corstone SSE-300 Technical
// Reference Manual, 101773; addresses: Arm, AN547].
#pragma once

#include "boards/bare_metal/registers.hpp"

namespace bare {

// The clock of core, counter and timers.
constexpr std::uint32_t kClockHz = 32'000'000;

// One counter, which counts up, for all timers; a timer interrupts while the counter is not below
// its comparator. Timer 0 begins the cycles.
constexpr std::uintptr_t kCounterControl = 0x58100000, kTimer = 0x58000000;
constexpr std::uintptr_t kCount = 0x00, kCountHigh = 0x04;  // offsets, as the next ones
constexpr std::uintptr_t kCompare = 0x20, kCompareHigh = 0x24, kControl = 0x2C;
constexpr std::uint32_t kEnabled = 1;
constexpr std::uint32_t kTimerIrq = 3;

// It has a clock of its own.
constexpr std::uintptr_t kWatchdog = 0x5802E000;
constexpr std::uint32_t kWatchdogHz = 32'768;

}  // namespace bare
