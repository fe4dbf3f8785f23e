// Fault: a call through a pointer that could reach any function.
extern "C" double planted(double (*function)(double), double x);
double planted(double (*function)(double), double x) {
  return 1.0 + function(x);
}
