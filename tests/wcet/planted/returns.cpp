// A loop that may return from its body: at most ten runs of a thousand instructions each.
#include "kernel/core/loop_bound.hpp"

extern "C" double planted(const double* values, int count);
double planted(const double* values, int count) {
  double product = 1.0;
  tactus::LoopBound<10> factors;
  for (int i = 0; i < count; ++i) {
    factors.tick();
    asm volatile(".rept 1000\n nop\n .endr" ::: "memory");
    if (values[i] == 0.0) return 0.0;
    product = product * values[i] + 1.0;
  }
  return product;
}
