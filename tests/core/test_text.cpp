// Tests Text, the buffer that error messages are built in: numbers, truncation and the final zero.
#include "kernel/core/text.hpp"

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "kernel/load/number.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

template <class Value>
void assert_text(const Value& value, const char* expected) {
  Text<40> text;
  text << value;
  assert_string_equal(text.c_str(), expected);
}

// Proves CFG-2.

void a_double_is_written_with_six_significant_digits_a_whole_number_with_all(void**) {
  struct {
    double value;
    const char* text;
  } const cases[] = {{0.0, "0"},
                     {-0.0, "0"},
                     {1.0, "1"},
                     {-2.8973, "-2.8973"},
                     {0.1 + 0.2, "0.3"},
                     {0.785398163, "0.785398"},
                     {2.0 / 3.0, "0.666667"},
                     {100.0, "100"},
                     {1e5, "100000"},
                     {1234567.8, "1234570"},
                     {999999.6, "1000000"},
                     {99999.951, "100000"},
                     {999999499.4, "999999000"},
                     {999999499.0, "999999499"},
                     {16777216.0, "16777216"},
                     {-4294967295.0, "-4294967295"},
                     {4294967296.0, "4.29497e9"},
                     {1e9, "1e9"},
                     {-1.5e12, "-1.5e12"},
                     {0.00001, "0.00001"},
                     {1.23456789e-5, "0.0000123457"},
                     {1.5e-6, "1.5e-6"},
                     {9.9999996e-6, "0.00001"},
                     {1.7976931348623157e308, "1.79769e308"},
                     {4.94e-324, "4.94066e-324"},
                     {kInfinity, "inf"},
                     {-kInfinity, "-inf"},
                     {kRequired, "nan"}};
  for (const auto& c : cases) assert_text(c.value, c.text);
}

void a_written_double_reads_back_to_six_digits(void**) {
  std::mt19937_64 random(20261120);
  for (int i = 0; i < 50'000; ++i) {
    const std::uint64_t pattern = random();
    double value = 0.0, read = 0.0;
    std::memcpy(&value, &pattern, sizeof value);
    if (!std::isfinite(value) || std::abs(value) > 1e308 || std::abs(value) < 1e-300) continue;
    Text<40> text;
    text << value;
    assert_true(parse_number(text, read));
    assert_true(std::abs(read / value - 1.0) < 5.0001e-6);
  }
}

void an_integer_is_written_whole(void**) {
  assert_text(0, "0");
  assert_text(-1, "-1");
  assert_text(2147483647, "2147483647");
  assert_text(std::numeric_limits<int>::min(), "-2147483648");
  assert_text(std::size_t{18446744073709551}, "18446744073709551");
  char buffer[32];
  buffer[append_int(buffer, 0, 31, std::numeric_limits<long long>::min())] = '\0';
  assert_string_equal(buffer, "-9223372036854775808");
}

void a_range_is_worded_as_a_requirement(void**) {
  assert_text(kPositive, "> 0");
  assert_text(kNonNegative, ">= 0");
  assert_text(kAny, "finite");
  assert_text(Range{0.0, 16.0}, "in [0, 16]");
  assert_text(Range{-2.5, 100000.0}, "in [-2.5, 100000]");
  assert_text(Range{2.0, kInfinity}, ">= 2");
  assert_text(Range{kPositive.lo, 1.0}, "> 0 and at most 1");
}

void text_that_does_not_fit_is_cut_and_stays_a_string(void**) {
  struct {
    Text<4> text;
    char behind[8] = "behind.";
  } memory;
  memory.text << "ab" << -12345 << 1.5 << "more";
  assert_string_equal(memory.text.c_str(), "ab-1");
  assert_string_equal(memory.behind, "behind.");
  assert_int_equal(std::string_view(memory.text).size(), 4);
  assert_true(Text<4>("").empty() && !memory.text.empty());
  assert_string_equal(Text<4>("abcdefgh").c_str(), "abcd");
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_double_is_written_with_six_significant_digits_a_whole_number_with_all),
      cmocka_unit_test(a_written_double_reads_back_to_six_digits),
      cmocka_unit_test(an_integer_is_written_whole),
      cmocka_unit_test(a_range_is_worded_as_a_requirement),
      cmocka_unit_test(text_that_does_not_fit_is_cut_and_stays_a_string),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
