// Loops that run more often than their header says, or whose header says nothing. Each run of a
// body takes a hundred instructions, so that what a bound lacks is plain.
#include <cstddef>
#include <cstdint>

#include "kernel/core/loop_bound.hpp"

#define TURN asm volatile(".rept 100\n nop\n .endr" ::: "memory")

namespace {

constexpr int kFew = 3;
constexpr std::size_t kLeast = 3;
int chosen;

template <int kFew>
void many() {
  for (int i = 0; i < kFew; ++i) TURN;
}
template <int kFew>
double template_bound(const double* values, int count) {
  double total = 1.0;
  tactus::LoopBound<kFew> turns;
  for (int i = 0; i < count; ++i) {
    turns.tick();
    total = total * values[i] + 1.0;
    asm volatile("" ::: "memory");
  }
  return total;
}
void less(int& i) {
  i -= 2;
}

}  // namespace

extern "C" {
// Bounded by the counter of the image.
// clang-format off
void two_on_a_line() {
  for (int i = 0; i < 30; ++i) for (int j = 0; j < 70; ++j) TURN;
}
// clang-format on
void shadowed_constant() {
  many<50>();
}
void steps_of_three() {
  for (std::uint8_t i = 1; i != 0; i = static_cast<std::uint8_t>(i + 3)) TURN;
}
void downward() {
  for (std::size_t i = 40; i-- > 0;) TURN;
}
void interchanged(double (*a)[30]) {
  for (int i = 0; i < 30; ++i)
    for (int j = 0; j < 70; ++j) a[j][i] = a[j][i] * 1.5;
}
void by_lambda() {
  const auto turns = [](int count) {
    for (int i = 0; i < count; ++i) TURN;
  };
  turns(20);
}

// Refused.
void second_change(const int* x) {
  for (int i = 0; i < kFew; ++i) {
    TURN;
    if (x[i] > 0) i -= 2;
  }
}
void changed_by_reference(const int* x) {
  for (int i = 0; i < kFew; ++i) {
    TURN;
    if (x[i] > 0) less(i);
  }
}
void changed_by_pointer() {
  for (chosen = 0; chosen < kFew; ++chosen) TURN;
}
void changed_by_lambda(const int* x) {
  int i = 0;
  const auto back = [&i] { i -= 2; };
  for (i = 0; i < kFew; ++i) {
    TURN;
    if (x[i] > 0) back();
  }
}
void continued(const int* x) {
  for (int i = 0; i < kFew; ++i) {
    TURN;
    if (x[i] > 0) {
      --i;
      continue;
    }
    chosen = i;
  }
}
void moving_end(const int* x) {
  for (int i = 0, end = kFew; i < end; ++i) {
    TURN;
    end += x[i];
  }
}
void narrow(int end) {
  for (std::uint8_t i = 0; i < end; ++i) TURN;
}
void wraps() {
  for (unsigned i = 3; i >= 0U; --i) TURN;
}
void floating() {
  for (float t = 0.0F; t < 1.0F; t += 0.1F) TURN;
}
void in_a_comment(const int* x) {
  while (*x > 0) TURN;  // LoopBound<3> turns; turns.tick();
}
void until(const int* x) {
  do TURN;
  while (*x > 0);
}

// A LoopBound that does not hold.
void ticks_at_times(int count) {
  tactus::LoopBound<3> turns;
  for (int i = 0; i < count; ++i) {
    TURN;
    if (chosen > i) turns.tick();
  }
}
void ticks_in_an_inner_loop(int count) {
  tactus::LoopBound<3> turns;
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j) {
      turns.tick();
      TURN;
    }
  }
}
double another_bound_of_that_name(const double* values, int count) {
  double total = 1.0;
  {
    tactus::LoopBound<3> turns;
    turns.tick();
  }
  for (int i = 0; i < count; ++i) {
    tactus::LoopBound<3> turns;
    turns.tick();
    total = total * values[i] + 1.0;
    asm volatile("" ::: "memory");
  }
  return total;
}
double two_bounds_in_sight(const double* values, int count) {
  double total = 1.0;
  tactus::LoopBound<300> turns;
  turns.tick();
  {
    tactus::LoopBound<3> turns;
    for (int i = 0; i < count; ++i) {
      turns.tick();
      total = total * values[i] + 1.0;
      asm volatile("" ::: "memory");
    }
  }
  return total;
}
double bound_that_wraps(const double* values, int count) {
  double total = 1.0;
  tactus::LoopBound<kLeast - 5 + 10> turns;
  for (int i = 0; i < count; ++i) {
    turns.tick();
    total = total * values[i] + 1.0;
    asm volatile("" ::: "memory");
  }
  return total;
}
double bound_of_a_template(const double* values, int count) {
  return template_bound<50>(values, count);
}
}
