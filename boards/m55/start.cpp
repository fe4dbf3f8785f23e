// The vectors of the Cortex-M55 of MPS3, and the limits of its stacks.
#include "boards/bare_metal/startup.hpp"
#include "boards/m55/registers.hpp"

namespace bare {
namespace {

[[gnu::section(".vectors"), gnu::used]] constexpr auto kVectors =
    vectors_with_timer_at<kTimerIrq>();

}  // namespace

/// The core compares every change of a stack pointer with the limit, so no frame steps over it.
void guard_stacks() {
  asm volatile("msr msplim, %0\n msr psplim, %1" ::"r"(&cycle_stack_limit), "r"(&work_stack_limit));
}

}  // namespace bare
