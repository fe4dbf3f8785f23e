// CMocka for C++: the only file that includes cmocka.h, and always the last include of a test,
// because cmocka.h defines fail(), skip() and mock() as macros. A failed assertion is a longjmp:
// tests keep nothing on the stack that needs a destructor.
#pragma once

#include <cmath>
#include <csetjmp>
#include <cstdarg>
#include <cstddef>
#include <cstdint>
extern "C" {
#include <cmocka.h>
}
#undef fail
#undef skip
#undef mock

#define ASSERT_STATUS(actual, expected) \
  assert_int_equal(static_cast<int>(actual), static_cast<int>(expected))
#define ASSERT_OK(status) ASSERT_STATUS(status, 0)
#define ASSERT_OUTCOME(report, expected) ASSERT_STATUS((report).outcome, expected)
#define ASSERT_NEAR(actual, expected, tolerance) \
  assert_near((actual), (expected), (tolerance), #actual, __FILE__, __LINE__)

/// Compares doubles, where cmocka's own comparison casts to float; NaN fails.
inline void assert_near(double actual, double expected, double tolerance, const char* what,
                        const char* file, int line) {
  if (std::abs(actual - expected) <= tolerance) return;
  print_error("%s = %.17g, expected %.17g within %.1g\n", what, actual, expected, tolerance);
  _fail(file, line);
}
