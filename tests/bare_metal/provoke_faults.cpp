#include "boards/bare_metal/provoke.hpp"

#include <atomic>

#include "boards/bare_metal/registers.hpp"
#include "hal/serial/protocol.hpp"

namespace bare {
namespace {

using tactus::serial::Provocation;

std::atomic<bool> cycle_hangs{false};
volatile int zero = 0;

[[noreturn]] void hang() {
  for (;;) {
  }
}

/// Each call needs another frame; the depth never becomes zero again.
int fill_stack(int depth) {
  volatile char frame[256];
  frame[0] = static_cast<char>(depth);
  return depth == zero ? 0 : fill_stack(depth + 1) + frame[0];
}

}  // namespace

tactus::Status provoke(tactus::ByteReader payload) {
  switch (static_cast<Provocation>(payload.u8())) {
    case Provocation::kHardFault: at(0xF0000000) = 1; break;
    case Provocation::kStackOverflow: zero = fill_stack(1); break;
    case Provocation::kStuckBackground: hang();
    case Provocation::kStuckCycle: cycle_hangs = true; break;
    case Provocation::kDivision: zero = 1000 / zero; break;
    default: return tactus::Status::kBadValue;
  }
  return tactus::Status::kOk;
}

void provoked_cycle() {
  if (cycle_hangs) hang();
}

}  // namespace bare
