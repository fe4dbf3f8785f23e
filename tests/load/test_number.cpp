// Tests numbers read from text against the C library's strtod.
#include "kernel/load/number.hpp"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <random>

#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr int kCases = 50'000;
constexpr std::uint64_t kSeed = 20261120;

std::uint64_t bits(double value) {
  std::uint64_t pattern;
  std::memcpy(&pattern, &value, sizeof pattern);
  return pattern;
}

/// Units in the last place between two doubles of the same sign.
std::uint64_t distance(double a, double b) {
  return bits(a) > bits(b) ? bits(a) - bits(b) : bits(b) - bits(a);
}

/// Reads `text` and compares the number, or its refusal, with strtod's.
void assert_as_strtod(const char* text, std::uint64_t ulps) {
  double value = 0.0;
  const double expected = std::strtod(text, nullptr);
  const bool good = parse_number(text, value) == std::isfinite(expected) &&
                    (!std::isfinite(expected) || distance(value, expected) <= ulps);
  if (!good) print_error("%s: %.17g, expected %.17g (seed %lu)\n", text, value, expected, kSeed);
  assert_true(good);
}

/// A random text of `digits` digits, with or without sign and point.
void random_digits(std::mt19937_64& random, int digits, char* text) {
  if (random() % 3 == 0) *text++ = random() % 2 == 0 ? '-' : '+';
  const int point = static_cast<int>(random() % (2 * static_cast<unsigned>(digits)));
  for (int i = 0; i < digits; ++i) {
    if (i == point) *text++ = '.';
    *text++ = static_cast<char>('0' + random() % 10);
  }
  *text = '\0';
}

void compare(int digits, int exponent, std::uint64_t ulps) {
  std::mt19937_64 random(kSeed);
  for (int i = 0; i < kCases; ++i) {
    char text[64], mantissa[48];
    random_digits(random, 1 + static_cast<int>(random() % static_cast<unsigned>(digits)), mantissa);
    const auto span = 2 * static_cast<unsigned>(exponent) + 1;
    const int e = static_cast<int>(random() % span) - exponent;
    std::snprintf(text, sizeof text, e == 0 ? "%s" : "%s%c%d", mantissa, i % 2 == 0 ? 'e' : 'E', e);
    assert_as_strtod(text, ulps);
  }
}

// Proves CFG-4.

void up_to_18_digits_are_read_to_the_bits_of_strtod(void**) {
  compare(15, 22, 0);
  compare(18, 22, 0);
  compare(18, 345, 0);  // includes infinite, subnormal and zero
}

void more_digits_are_read_within_one_unit_in_the_last_place(void**) {
  compare(40, 345, 1);
}

void every_double_written_with_17_digits_comes_back(void**) {
  std::mt19937_64 random(kSeed);
  for (int i = 0; i < kCases; ++i) {
    const std::uint64_t pattern = random();
    double written = 0.0, read = 0.0;
    std::memcpy(&written, &pattern, sizeof written);
    if (!std::isfinite(written)) continue;
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", written);
    assert_true(parse_number(text, read));
    assert_true(bits(read) == bits(written));
  }
}

void the_ends_of_the_range_and_the_ties_are_as_strtod_reads_them(void**) {
  for (const char* text : {"0",
                           "-0",
                           "+0",
                           "0e999",
                           "-0.000e-999",
                           "00000000000000000000000001",
                           "1.",
                           ".5",
                           "1.e2",
                           "4.9e-324",
                           "2.5e-324",
                           "2.4e-324",
                           "1e-342",
                           "1e-343",
                           "1e-400",
                           "1e-99999999999",
                           "2.2250738585072014e-308",
                           "2.2250738585072011e-308",
                           "1.7976931348623157e308",
                           "1.7976931348623159e308",
                           "999999999999999999e308",
                           "1e308",
                           "1e309",
                           "0.1e309",
                           "10e307",
                           "1e99999999999",
                           "9007199254740992",
                           "9007199254740993",
                           "9007199254740994",
                           "9007199254740995",
                           "0.1",
                           "0.3",
                           "123456789012345678"})
    assert_as_strtod(text, 0);
}

void what_is_not_wholly_a_finite_decimal_number_is_refused_and_changes_nothing(void**) {
  for (const char* text :
       {"",      " ",   "+",    "-",    ".",    "-.",   "e",        "e5",    ".e5",    "5e",
        "5e+",   "5e-", "+-5",  "-+5",  "++5",  "5.5.", "5..5",     "5e5e5", "5e5.",   "0x10",
        "0x1p3", "1f",  "1d0",  "1e5f", " 5",   "5 ",   "5 5",      "5,5",   "1_000",  "1'000",
        "nan",   "NaN", "-nan", "inf",  "-inf", "INF",  "infinity", "1e999", "-1e999", "1e309",
        "five",  "5%",  "−5",   "٥",    "5\t",  "\n5",  "1e 5",     "- 5",   "5-",     "0b1"}) {
    double value = 7.0;
    assert_false(parse_number(text, value));
    assert_true(value == 7.0);
  }
  double value = 7.0;
  assert_false(parse_number(std::string_view("5\0", 2), value));
}

void whole_numbers_are_read_if_they_fit(void**) {
  struct {
    const char* text;
    int value;
  } const cases[] = {{"0", 0},
                     {"-0", 0},
                     {"+7", 7},
                     {"007", 7},
                     {"-12", -12},
                     {"2147483647", 2147483647},
                     {"-2147483647", -2147483647},
                     {"0000000000000000000012", 12}};
  for (const auto& c : cases) {
    int value = 1;
    assert_true(parse_number(c.text, value));
    assert_int_equal(value, c.value);
  }
  for (const char* text :
       {"", "+", "-", "+-1", "1.0", "1e3", "0x10", " 1", "1 ", "one", "2147483648", "-2147483649",
        "4294967297", "18446744073709551617", "1-"}) {
    int value = 1;
    assert_false(parse_number(text, value));
    assert_int_equal(value, 1);
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(up_to_18_digits_are_read_to_the_bits_of_strtod),
      cmocka_unit_test(more_digits_are_read_within_one_unit_in_the_last_place),
      cmocka_unit_test(every_double_written_with_17_digits_comes_back),
      cmocka_unit_test(the_ends_of_the_range_and_the_ties_are_as_strtod_reads_them),
      cmocka_unit_test(what_is_not_wholly_a_finite_decimal_number_is_refused_and_changes_nothing),
      cmocka_unit_test(whole_numbers_are_read_if_they_fit),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
