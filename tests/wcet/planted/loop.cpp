// A loop whose end depends on data: scripts/wcet_bound must refuse it, by this file and line 7.
#include "kernel/types.hpp"

extern "C" double planted(const double* values, int count);
double planted(const double* values, int count) {
  double sum = 0.0;
  for (int i = 0; i < count; ++i) sum += values[i] * sum;
  return sum;
}
