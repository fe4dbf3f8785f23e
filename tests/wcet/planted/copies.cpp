// Copies: their loops run as often as the size says.
#include <cstdint>
#include <cstring>

#include "boards/bare_metal/memory.cpp"

struct Large {
  unsigned char bytes[3200];
};

extern "C" {
void copy_of_an_object(Large* to, const Large* from) {
  *to = *from;
}
void zeros(Large* to) {
  *to = {};
}
void copy_of_any_size(unsigned char* to, const unsigned char* from, unsigned size) {
  std::memcpy(to, from, size);
}
void copy_of_two_sizes(unsigned char* to, const unsigned char* from, bool more) {
  std::memcpy(to, from, more ? 3200 : 40);
}
void move(unsigned char* to, const unsigned char* from, unsigned size) {
  std::memmove(to, from, size);
}
std::uint64_t division(std::uint64_t a, std::uint64_t b) {
  return a / b;
}
int cases(int which, int x) {
  switch (which) {
    case 0: asm volatile("nop"); return x * 3;
    case 1: asm volatile("nop\nnop"); return x + 4;
    case 2: asm volatile("nop\nnop\nnop"); return x - 4;
    case 3: asm volatile(".rept 100\nnop\n.endr"); return x * 7;
    case 4: asm volatile("nop\nnop\nnop\nnop"); return x / 7;
    case 5: asm volatile("nop\nnop\nnop\nnop\nnop"); return x / 9;
    case 6: asm volatile("nop\nnop\nnop\nnop\nnop\nnop"); return x / 11;
  }
  return 0;
}
int jump(int which, int x) {
  static const void* const places[] = {&&first, &&second, &&third};
  goto* places[which];
first:
  x *= 3;
second:
  x += 5;
third:
  return x;
}
}
