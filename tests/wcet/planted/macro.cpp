// A loop that a macro hides on the line of another.
#include "kernel/core/loop_bound.hpp"

#define EVERY(count) for (int k = 0; k < (count); ++k)

extern "C" double planted(const double* values, int count);
double planted(const double* values, int count) {
  double product = 1.0;
  tactus::LoopBound<3> factors;
  for (int i = 0; i < count; ++i) {
    factors.tick();
    EVERY(count) product = product * values[k] + 1.0;
    asm volatile("" ::: "memory");
  }
  return product;
}
