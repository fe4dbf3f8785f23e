// Fault: an object on the heap.
extern "C" double* planted(int count);
double* planted(int count) {
  return new double[static_cast<unsigned>(count)];
}
