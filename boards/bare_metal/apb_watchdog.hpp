// The watchdog of Arm's Cortex-M System Design Kit: an interrupt, which is the NMI, at the first
// end of its time, a reset at the next.
// [DDI 0479D, chapter 4]
#pragma once

#include "boards/bare_metal/registers.hpp"

namespace bare {

struct ApbWatchdog {
  std::uintptr_t base;

  /// Expects to be fed after that many of its clock's ticks at the latest. [init]
  void start(std::uint32_t ticks) const {
    at(base + kLock) = kKey;
    at(base + kLoad) = ticks;
    at(base + kControl) = 3;  // interrupt and reset
    at(base + kLock) = 0;
  }
  /// [any]
  void feed() const {
    at(base + kLock) = kKey;
    at(base + kClear) = 1;
    at(base + kLock) = 0;
  }

 private:
  static constexpr std::uintptr_t kLoad = 0x0, kControl = 0x8, kClear = 0xC, kLock = 0xC00;
  static constexpr std::uint32_t kKey = 0x1ACCE551;
};

}  // namespace bare
