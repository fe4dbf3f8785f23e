// Registers of the Cortex-M7 [Arm, Armv7-M Architecture Reference Manual, DDI 0403E, B3.2, B3.3 and
// B3.5] and of the peripherals that the board uses [Arm, Cortex-M System Design Kit, DDI 0479D,
// chapter 4; addresses: Arm, AN500].
#pragma once

#include <cstdint>

namespace m7 {

inline volatile std::uint32_t& at(std::uintptr_t address) {
  return *reinterpret_cast<volatile std::uint32_t*>(address);
}

// System control block.
constexpr std::uintptr_t kAircr = 0xE000ED0C, kCcr = 0xE000ED14, kShcsr = 0xE000ED24;
constexpr std::uintptr_t kCfsr = 0xE000ED28, kHfsr = 0xE000ED2C;
constexpr std::uintptr_t kMmfar = 0xE000ED34, kBfar = 0xE000ED38;
constexpr std::uint32_t kSystemReset = 0x05FA0004;  // key, SYSRESETREQ
constexpr std::uint32_t kDivisionTraps = 1U << 4;
constexpr std::uint32_t kFaultsEnabled = 7U << 16;  // memory, bus, usage

// Memory protection unit.
constexpr std::uintptr_t kMpuCtrl = 0xE000ED94, kMpuRnr = 0xE000ED98, kMpuRbar = 0xE000ED9C;
constexpr std::uintptr_t kMpuRasr = 0xE000EDA0;

// Interrupt controller.
constexpr std::uintptr_t kNvicIser = 0xE000E100, kNvicIspr = 0xE000E200;

// The clock of core and peripherals.
constexpr std::uint32_t kClockHz = 25'000'000;

// APB timers, which count down: 0 begins the cycles, 1 tells the time.
constexpr std::uintptr_t kTimer = 0x40000000, kClock = 0x40001000;
constexpr std::uintptr_t kCtrl = 0x0, kValue = 0x4, kReload = 0x8, kIntClear = 0xC;  // offsets
constexpr std::uint32_t kEnabled = 1, kInterrupts = 8;
constexpr std::uint32_t kTimerIrq = 8;

// APB watchdog: an interrupt, which is the NMI, at the first end of its time, a reset at the next.
constexpr std::uintptr_t kWatchdogLoad = 0x40008000, kWatchdogControl = 0x40008008;
constexpr std::uintptr_t kWatchdogClear = 0x4000800C, kWatchdogLock = 0x40008C00;
constexpr std::uint32_t kWatchdogKey = 0x1ACCE551;

}  // namespace m7
