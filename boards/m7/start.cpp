// The vectors of the Cortex-M7 of MPS2, and the guards of its stacks.
#include "boards/bare_metal/startup.hpp"
#include "boards/m7/registers.hpp"

namespace bare {
namespace {

[[gnu::section(".vectors"), gnu::used]] constexpr auto kVectors =
    vectors_with_timer_at<kTimerIrq>();

/// The 4 KiB below a stack are protected: an overflow is a fault. They are more than the frame of
/// any function has, so none can step over them.
void guard_stack(std::uint32_t region, const std::uint32_t& guard) {
  at(kMpuRnr) = region;
  at(kMpuRbar) = static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(&guard));
  at(kMpuRasr) = 1U << 28 | 11U << 1 | 1U;  // execute never, no access, 2^(11+1) bytes, on
}

}  // namespace

void guard_stacks() {
  guard_stack(0, cycle_stack_guard);
  guard_stack(1, work_stack_guard);
  at(kMpuCtrl) = 5U;  // on; elsewhere the default map
}

}  // namespace bare
