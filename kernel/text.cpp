#include "kernel/text.hpp"

#include <cmath>

namespace tactus {
namespace {

constexpr int kSignificant = 6;  // digits of a double in a message

/// Scales a positive finite value to a kSignificant-digit integer; returns its decimal exponent.
int to_decimal(double value, long long& digits) {
  int exponent = 0;
  double limit = 1.0;
  for (int i = 0; i < kSignificant; ++i) limit *= 10.0;
  for (int i = 0; i < 330 && value >= limit; ++i, ++exponent) value /= 10.0;
  for (int i = 0; i < 330 && value < limit / 10.0; ++i, --exponent) value *= 10.0;
  digits = static_cast<long long>(value + 0.5);
  return exponent;
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

std::size_t append_double(char* buffer, std::size_t size, std::size_t capacity, double value) {
  if (std::isnan(value)) return append_text(buffer, size, capacity, "nan");
  if (value < 0.0) {
    size = append_text(buffer, size, capacity, "-");
    value = -value;
  }
  if (std::isinf(value)) return append_text(buffer, size, capacity, "inf");
  if (value == 0.0) return append_text(buffer, size, capacity, "0");

  long long digits = 0;
  int exponent = to_decimal(value, digits);  // value = digits * 10^exponent
  for (int i = 0; i < kSignificant && digits % 10 == 0; ++i, ++exponent) digits /= 10;
  if (exponent > 0 && exponent <= 3) {
    for (; exponent > 0; --exponent) digits *= 10;
  }
  if (exponent > 0 || exponent < -kSignificant - 3) {  // scientific
    size = append_int(buffer, size, capacity, digits);
    size = append_text(buffer, size, capacity, "e");
    return append_int(buffer, size, capacity, exponent);
  }
  long long unit = 1;
  for (int i = exponent; i < 0; ++i) unit *= 10;
  size = append_int(buffer, size, capacity, digits / unit);
  if (exponent == 0) return size;
  size = append_text(buffer, size, capacity, ".");
  for (long long rest = digits % unit; unit > 1; rest %= unit) {
    unit /= 10;
    const char digit = static_cast<char>('0' + rest / unit);
    size = append_text(buffer, size, capacity, {&digit, 1});
  }
  return size;
}

}  // namespace tactus
