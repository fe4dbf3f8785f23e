#include "kernel/load/number.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace tactus {
namespace {

// Bounds of the exponent of ten: a whole number times 10^309 is infinite, and 10^18, the bound of
// the mantissa, times 10^-343 is below half of the smallest double.
constexpr int kLargestExponent = 308, kSmallestExponent = -342;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool take_sign(std::string_view& text) {
  const bool negative = !text.empty() && text.front() == '-';
  if (!text.empty() && (text.front() == '-' || text.front() == '+')) text.remove_prefix(1);
  return negative;
}

/// Takes digits, one optional point, digits: mantissa * 10^exponent. False if there is no digit.
bool take_mantissa(std::string_view& text, std::uint64_t& mantissa, int& exponent) {
  bool any = false, point = false;
  for (; !text.empty(); text.remove_prefix(1)) {
    const char c = text.front();
    if (c == '.' && !point) {
      point = true;
      continue;
    }
    if (!is_digit(c)) break;
    any = true;
    if (mantissa < 100'000'000'000'000'000U) {  // 18 digits count; more only shift
      mantissa = mantissa * 10 + static_cast<std::uint64_t>(c - '0');
      exponent -= point ? 1 : 0;
    } else {
      exponent += point ? 0 : 1;
    }
  }
  return any;
}

bool take_exponent(std::string_view& text, int& exponent) {
  if (text.empty() || (text.front() != 'e' && text.front() != 'E')) return true;
  text.remove_prefix(1);
  const bool negative = take_sign(text);
  if (text.empty() || !is_digit(text.front())) return false;
  int value = 0;
  for (; !text.empty() && is_digit(text.front()); text.remove_prefix(1)) {
    if (value < 10'000) value = value * 10 + (text.front() - '0');
  }
  exponent += negative ? -value : value;
  return true;
}

/// A whole number of 1152 bits, lowest limb first, enough for every finite double.
using Wide = std::array<std::uint32_t, 36>;
constexpr int kLimbBits = 32;

void multiply_by_ten(Wide& number) {
  std::uint64_t carry = 0;
  for (std::uint32_t& limb : number) {
    carry += std::uint64_t{10} * limb;
    limb = static_cast<std::uint32_t>(carry);
    carry >>= kLimbBits;
  }
}

/// Divides by ten and returns the remainder.
std::uint64_t divide_by_ten(Wide& number) {
  std::uint64_t rest = 0;
  for (std::size_t i = number.size(); i-- > 0;) {
    rest = rest << kLimbBits | number[i];
    number[i] = static_cast<std::uint32_t>(rest / 10);
    rest %= 10;
  }
  return rest;
}

bool bit(const Wide& number, int index) {
  return (number[static_cast<std::size_t>(index / kLimbBits)] >> index % kLimbBits & 1U) != 0;
}

/// Returns the double nearest to number * 2^unit, in a tie the even one. `cut` says that the exact
/// number is larger by a fraction. `unit` is so low that every bit that is rounded off is in the
/// number.
double nearest(const Wide& number, int unit, bool cut) {
  constexpr int kDigits = 53, kSmallest = -1074, kLargest = 971;  // of a double: bits, their units
  int length = kLimbBits * static_cast<int>(number.size());
  while (length > 0 && !bit(number, length - 1)) --length;
  int last = length - kDigits;  // place in `number` of the last bit to keep
  if (last + unit < kSmallest) last = kSmallest - unit;
  if (last + unit > kLargest) return std::numeric_limits<double>::infinity();
  std::uint64_t kept = 0;
  for (int i = length - 1; i >= last; --i) kept = kept << 1 | (bit(number, i) ? 1U : 0U);
  for (int i = 0; i < last - 1 && !cut; ++i) cut = bit(number, i);
  if (bit(number, last - 1) && (cut || (kept & 1U) != 0)) ++kept;
  // The exponent field counts from 1 where the leading bit, which is not stored, adds the one.
  const std::uint64_t pattern = (static_cast<std::uint64_t>(last + unit - kSmallest) << 52) + kept;
  double value = 0.0;
  std::memcpy(&value, &pattern, sizeof value);
  return value;
}

/// Returns mantissa * 10^exponent, rounded once.
double scale(std::uint64_t mantissa, int exponent) {
  if (mantissa == 0 || exponent < kSmallestExponent) return 0.0;
  if (exponent > kLargestExponent) return std::numeric_limits<double>::infinity();
  // The mantissa is above two free limbs if it grows, in the two highest limbs if it shrinks.
  Wide number{};
  const std::size_t low = exponent >= 0 ? 2 : number.size() - 2;
  number[low] = static_cast<std::uint32_t>(mantissa);
  number[low + 1] = static_cast<std::uint32_t>(mantissa >> kLimbBits);
  bool cut = false;
  for (int i = 0; i < exponent; ++i) multiply_by_ten(number);
  for (int i = exponent; i < 0; ++i) cut |= divide_by_ten(number) != 0;
  return nearest(number, -kLimbBits * static_cast<int>(low), cut);
}

}  // namespace

bool parse_number(std::string_view text, double& value) {
  const bool negative = take_sign(text);
  std::uint64_t mantissa = 0;
  int exponent = 0;
  if (!take_mantissa(text, mantissa, exponent) || !take_exponent(text, exponent)) return false;
  if (!text.empty()) return false;
  const double magnitude = scale(mantissa, exponent);
  if (!std::isfinite(magnitude)) return false;
  value = negative ? -magnitude : magnitude;
  return true;
}

bool parse_number(std::string_view text, int& value) {
  const bool negative = take_sign(text);
  if (text.empty()) return false;
  std::int64_t magnitude = 0;
  for (; !text.empty(); text.remove_prefix(1)) {
    if (!is_digit(text.front())) return false;
    magnitude = magnitude * 10 + (text.front() - '0');
    if (magnitude > std::numeric_limits<int>::max()) return false;
  }
  value = static_cast<int>(negative ? -magnitude : magnitude);
  return true;
}

}  // namespace tactus
