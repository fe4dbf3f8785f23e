// What the start of a board needs of its machine, in boards/<core>/start.cpp: the table of vectors
// and the protection of the stacks.
#pragma once

#include <cstdint>

extern "C" {
extern std::uint32_t cycle_stack_guard, cycle_stack_limit, cycle_stack_top, work_stack_guard,
    work_stack_limit;
[[noreturn]] void on_reset();
void on_fault();
void on_timer();
}

namespace bare {

/// As the core reads it after a reset: the stack of handlers, then the handlers.
template <int kInterrupts>
struct Vectors {
  const std::uint32_t* stack;
  void (*handlers[15 + kInterrupts])();
};

/// Every handler but that of the timer's interrupt, which is the last, ends the program.
template <int kTimerIrq>
constexpr Vectors<kTimerIrq + 1> vectors_with_timer_at() {
  Vectors<kTimerIrq + 1> table = {&cycle_stack_top, {}};
  for (auto& handler : table.handlers) handler = on_fault;
  table.handlers[0] = on_reset;
  table.handlers[15 + kTimerIrq] = on_timer;
  return table;
}

/// From now on a stack that overflows is a fault. [init]
void guard_stacks();

}  // namespace bare
