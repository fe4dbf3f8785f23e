#include "kernel/number.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace tactus {
namespace {

// Powers of ten that a double holds exactly.
constexpr std::array<double, 23> kPowersOfTen = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                 1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
constexpr int kLargestPower = static_cast<int>(kPowersOfTen.size()) - 1;
constexpr int kLargestExponent = 400;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool take_sign(std::string_view& text) {
  const bool negative = !text.empty() && text.front() == '-';
  if (!text.empty() && (text.front() == '-' || text.front() == '+')) text.remove_prefix(1);
  return negative;
}

/// Digits, one optional point, digits: mantissa * 10^exponent. False if there is no digit.
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
    if (mantissa < 100'000'000'000'000'000U) {  // 18 digits fit; more only shift
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
    if (value < kLargestExponent) value = value * 10 + (text.front() - '0');
  }
  exponent += negative ? -value : value;
  return true;
}

/// value * 10^exponent in steps that are exact powers; one step, hence one rounding, within +-22.
double scale(double value, int exponent) {
  const bool up = exponent > 0;
  int left = up ? exponent : -exponent;
  constexpr int kMaxSteps = 2 * kLargestExponent / kLargestPower;
  for (int i = 0; i < kMaxSteps && left > 0; ++i) {
    const int step = left < kLargestPower ? left : kLargestPower;
    const double power = kPowersOfTen[static_cast<std::size_t>(step)];
    value = up ? value * power : value / power;
    left -= step;
  }
  return value;
}

}  // namespace

bool parse_number(std::string_view text, double& value) {
  const bool negative = take_sign(text);
  std::uint64_t mantissa = 0;
  int exponent = 0;
  if (!take_mantissa(text, mantissa, exponent) || !take_exponent(text, exponent)) return false;
  if (!text.empty()) return false;
  const double magnitude = scale(static_cast<double>(mantissa), exponent);
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
