// A loop with its own bound: no fault.
#include "kernel/core/loop_bound.hpp"

extern "C" double planted(const double* values, int count);
double planted(const double* values, int count) {
  double product = 1.0;
  tactus::LoopBound<10> factors;
  for (int i = 0; i < count; ++i) {
    factors.tick();
    product = product * values[i] + 1.0;
    asm volatile("" ::: "memory");
  }
  return product;
}
