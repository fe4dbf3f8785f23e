// A loop that claims the line of a LoopBound which is not its own.
#include "kernel/core/loop_bound.hpp"

extern "C" double planted(const double* values, int count);
double planted(const double* values, int count) {
  double product = 1.0;
# 12
  for (int i = 0; i < count; ++i) product = product * values[i] + 1.0;
  if (product > 0.0) return product;

  tactus::LoopBound<3> factors;
  for (int i = 0; i < 3 && product < 0.0; ++i) {
    factors.tick();
    product = product * values[i] + 1.0;
  }
  return product;
}
