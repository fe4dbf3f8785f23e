// What the sources of the CAN part take from a C library when they are configured, and nothing else
// of it: outside the cycle.
#include <cstddef>

extern "C" {
void* memchr(const void* text, int wanted, std::size_t size) {
  auto* each = static_cast<unsigned char*>(const_cast<void*>(text));
  for (std::size_t i = 0; i < size; ++i)
    if (each[i] == static_cast<unsigned char>(wanted)) return each + i;
  return nullptr;
}
int* __errno() {
  static int error = 0;
  return &error;
}
}
