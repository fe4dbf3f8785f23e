// Fault: a loop with two entries.
extern "C" int planted(int x, int y);
int planted(int x, int y) {
  int sum = 0;
  if (x > 0) goto middle;
again:
  sum += y;
  asm volatile("" : "+r"(sum));
middle:
  sum += x;
  asm volatile("" : "+r"(sum));
  if (sum < 100) goto again;
  return sum;
}
