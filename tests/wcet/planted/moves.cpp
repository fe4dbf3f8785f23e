// A loop whose counter is the address that its loads move along a list on the stack, tested in the
// middle of the loop: three runs of a thousand instructions.
#include <initializer_list>

namespace {
[[gnu::noinline]] double slow(double value) {
  asm volatile(".rept 1000\n nop\n .endr" : "+w"(value)::"r0", "r1", "r2", "r3", "ip", "memory");
  return value;
}
}  // namespace

extern "C" double planted(const double* from, double first, double second, double third);
double planted(const double* from, double first, double second, double third) {
  double least = *from;
  for (const double value : {first, second, third}) {
    const double next = slow(*from > value ? *from : value);
    least = next < least ? next : least;
  }
  return least;
}
