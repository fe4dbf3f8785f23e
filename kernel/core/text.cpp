#include "kernel/core/text.hpp"

#include <cmath>
#include <cstdint>
#include <limits>

namespace tactus {
namespace {

constexpr int kMostSignificant = 9;
// Values of Decimal::point for which a number has no exponent: 0.00001 to 999999000.
constexpr int kSmallestPlain = -4, kLargestPlain = 9;

/// The decimal digits of a positive finite value, 0.d1 d2 d3 ... * 10^point, without trailing
/// zeros.
struct Decimal {
  char digits[kMostSignificant];
  int count, point;

  Decimal(double value, int significant) : count(significant), point(significant) {
    double limit = 1.0;
    for (int i = 0; i < significant; ++i) limit *= 10.0;
    for (int i = 0; i < 330 && value >= limit; ++i, ++point) value /= 10.0;
    for (int i = 0; i < 330 && value < limit / 10.0; ++i, --point) value *= 10.0;
    auto rounded = static_cast<long>(value + 0.5);
    if (rounded >= static_cast<long>(limit)) {
      rounded /= 10;
      ++point;
    }
    for (int i = significant; i-- > 0; rounded /= 10)
      digits[i] = static_cast<char>('0' + rounded % 10);
    while (count > 1 && digits[count - 1] == '0') --count;
  }
  /// Appends the digits at the places from <= i < to; zeros where there are none.
  std::size_t append(char* buffer, std::size_t size, std::size_t capacity, int from, int to) const {
    for (int i = from; i < to; ++i)
      size = append_text(buffer, size, capacity, {i >= 0 && i < count ? &digits[i] : "0", 1});
    return size;
  }
};

/// True for a 32-bit integer that six digits do not distinguish from the next.
bool has_more_digits(double value) {
  if (!(value <= std::numeric_limits<std::uint32_t>::max())) return false;
  auto whole = static_cast<std::uint32_t>(value);
  if (static_cast<double>(whole) != value) return false;
  for (int i = 0; i < 10 && whole % 10 == 0; ++i) whole /= 10;
  return whole >= 1'000'000;
}

}  // namespace

std::size_t append_text(char* buffer, std::size_t size, std::size_t capacity,
                        std::string_view text) {
  for (const char c : text) {
    if (size >= capacity) break;
    buffer[size++] = c;
  }
  buffer[size] = '\0';
  return size;
}

std::size_t append_int(char* buffer, std::size_t size, std::size_t capacity, long long value) {
  char digits[20];
  int count = 0;
  const bool negative = value < 0;
  unsigned long long rest = negative ? 0ULL - static_cast<unsigned long long>(value)
                                     : static_cast<unsigned long long>(value);
  do {
    digits[count++] = static_cast<char>('0' + rest % 10);
    rest /= 10;
  } while (rest != 0 && count < 20);
  if (negative) size = append_text(buffer, size, capacity, "-");
  while (count > 0) size = append_text(buffer, size, capacity, {&digits[--count], 1});
  return size;
}

std::size_t append_double(char* buffer, std::size_t size, std::size_t capacity, double value,
                          int significant) {
  if (std::isnan(value)) return append_text(buffer, size, capacity, "nan");
  if (value < 0.0) {
    size = append_text(buffer, size, capacity, "-");
    value = -value;
  }
  if (std::isinf(value)) return append_text(buffer, size, capacity, "inf");
  if (value == 0.0) return append_text(buffer, size, capacity, "0");
  if (has_more_digits(value))
    return append_int(buffer, size, capacity, static_cast<std::uint32_t>(value));

  const Decimal decimal(value, significant);
  const bool plain = decimal.point >= kSmallestPlain && decimal.point <= kLargestPlain;
  const int whole = plain ? decimal.point : 1;  // digits before the point
  if (whole <= 0) size = append_text(buffer, size, capacity, "0");
  size = decimal.append(buffer, size, capacity, 0, whole);
  if (decimal.count > whole) {
    size = append_text(buffer, size, capacity, ".");
    size = decimal.append(buffer, size, capacity, whole, decimal.count);
  }
  if (plain) return size;
  size = append_text(buffer, size, capacity, "e");
  return append_int(buffer, size, capacity, decimal.point - 1);
}

}  // namespace tactus
