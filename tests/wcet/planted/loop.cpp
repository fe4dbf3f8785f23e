// Fault: a loop whose end depends on data; scripts/wcet_bound must name it.
extern "C" double planted(const double* values, int count);
double planted(const double* values, int count) {
  double sum = 0.0;
  for (int i = 0; i < count; ++i) sum += values[i] * sum;
  return sum;
}
