// Registers that every Cortex-M from Armv7-M on has [Arm, Armv7-M Architecture Reference Manual,
// DDI 0403E, B3.2 to B3.4; Armv8-M, DDI 0553B, D1.2]. Those of a machine are in
// boards/<core>/registers.hpp.
#pragma once

#include <cstdint>

namespace bare {

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

// Interrupt controller: the registers of the first 32 interrupts.
constexpr std::uintptr_t kNvicIser = 0xE000E100, kNvicIspr = 0xE000E200;

}  // namespace bare
