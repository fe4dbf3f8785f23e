#include "gateway/trajectory/smoothing/digits.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace tactus {

namespace {

constexpr int kMostExponent = 400;  // beyond it a double is 0 or infinite

}  // namespace

void Digits::note(std::string_view number) {
  const std::size_t end = std::min(number.find_first_of("eE"), number.size());
  int exponent = 0;
  if (end + 1 < number.size()) {
    const char* const first = number.data() + end + (number[end + 1] == '+' ? 2 : 1);
    std::from_chars(first, number.data() + number.size(), exponent);
  }
  int decimals = -std::clamp(exponent, -kMostExponent, kMostExponent), significant = 0;
  bool behind_point = false;
  for (const char letter : number.substr(0, end)) {
    behind_point |= letter == '.';
    if (letter < '0' || letter > '9') continue;
    decimals += behind_point ? 1 : 0;
    significant += significant > 0 || letter != '0' ? 1 : 0;
  }
  decimals_ = std::max(decimals_, decimals);
  significant_ = std::max(significant_, significant);
}

double Digits::half_unit(double number) const {
  const double by_decimals = std::pow(10.0, -decimals_), size = std::abs(number);
  const double by_size =
      size > 0.0 ? std::pow(10.0, std::floor(std::log10(size)) + 1.0 - significant_) : 0.0;
  return 0.5 * std::max(by_decimals, by_size);
}

}  // namespace tactus
