// Fault: a frame of four kilobytes.
extern "C" void use(double* values);
void use(double* values) {
  values[0] = 1.0;
}
extern "C" double planted(double x);
double planted(double x) {
  volatile double values[512];
  for (int i = 0; i < 512; ++i) values[i] = x;
  return values[17];
}
