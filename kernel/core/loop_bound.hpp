// LoopBound: the largest number of runs of a loop without a counter of constant step and end.
//
//   LoopBound<15> halvings;
//   while (found - before > 1) {
//     halvings.tick();
//
// Without sanitizers it compiles to nothing. With them, as in the sanitized tests, one run
// too many aborts the program and names the place of the tick. scripts/wcet reads the number for
// the static bound, so the bound uses only numbers that the tests have checked. It asks that the
// tick is the first statement of the body, on a line of its own.
#pragma once

#ifdef TACTUS_SANITIZED
#include <cassert>
#endif

namespace tactus {

/// Allows at most `most` ticks in its life. Declared before a loop, it bounds each entry of the
/// loop; passed by reference, it bounds the sum of all loops that tick it.
template <int most>
class LoopBound {
  static_assert(most > 0);

 public:
#ifndef TACTUS_SANITIZED
  constexpr void tick() {}
#else
  /// Counts one run of the loop's body. [any]
  void tick(const char* file = __builtin_FILE(), unsigned line = __builtin_LINE()) {
    if (++ticks_ > most)
      __assert_fail("the loop runs more often than its LoopBound", file, line, "");
  }

 private:
  int ticks_ = 0;
#endif
};

}  // namespace tactus
