// Registers of the Cortex-M7's memory protection [Arm, Armv7-M Architecture Reference Manual,
// DDI 0403E, B3.5] and of the machine's peripherals [Arm, Cortex-M System Design Kit, DDI 0479D,
// chapter 4; addresses: Arm, AN500].
#pragma once

#include "boards/bare_metal/registers.hpp"

namespace bare {

constexpr std::uintptr_t kMpuCtrl = 0xE000ED94, kMpuRnr = 0xE000ED98, kMpuRbar = 0xE000ED9C;
constexpr std::uintptr_t kMpuRasr = 0xE000EDA0;

// The clock of core and peripherals.
constexpr std::uint32_t kClockHz = 25'000'000;

// APB timers, which count down: 0 begins the cycles, 1 tells the time.
constexpr std::uintptr_t kTimer = 0x40000000, kClock = 0x40001000;
constexpr std::uintptr_t kCtrl = 0x0, kValue = 0x4, kReload = 0x8, kIntClear = 0xC;  // offsets
constexpr std::uint32_t kEnabled = 1, kInterrupts = 8;
constexpr std::uint32_t kTimerIrq = 8;

constexpr std::uintptr_t kWatchdog = 0x40008000;

}  // namespace bare
