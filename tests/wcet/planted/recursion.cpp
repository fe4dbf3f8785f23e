// Fault: a function that calls itself through another.
extern "C" double planted(double x, int depth);
[[gnu::noinline]] static double other(double x, int depth) {
  return 1.0 + planted(0.5 * x, depth - 1);
}
[[gnu::noinline]] double planted(double x, int depth) {
  return depth == 0 ? x : x * other(x + 1.0, depth);
}
