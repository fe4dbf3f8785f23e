// LoopBound: how often a loop runs at most, said beside the loop where its header does not say it.
//
//   LoopBound<31> halvings;
//   while (found - before > 1) {
//     halvings.tick();
//
// In a release it is nothing. With assertions on, as in the sanitized tests, one run too many stops
// the program with the place of the tick. scripts/wcet reads the number for the static bound, so
// what the bound rests on is what the tests have checked.
#pragma once

#ifndef NDEBUG
#include <cassert>
#endif

namespace tactus {

/// Ticks at most `most` times in its life. Declared before a loop it bounds each entry of the loop;
/// passed on by reference it bounds the sum of all loops that tick it.
template <int most>
class LoopBound {
  static_assert(most > 0);

 public:
#ifdef NDEBUG
  constexpr void tick() {}
#else
  /// The body of the loop runs once more. [any]
  void tick(const char* file = __builtin_FILE(), unsigned line = __builtin_LINE()) {
    if (++ticks_ > most)
      __assert_fail("the loop runs more often than its LoopBound", file, line, "");
  }

 private:
  int ticks_ = 0;
#endif
};

}  // namespace tactus
