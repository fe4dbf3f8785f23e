// Digits: how precisely the numbers of a column were written, known from the digits of all of them:
// "%f" writes six decimals, "%g" six significant digits of which it leaves out zeros at the end.
#pragma once

#include <string_view>

namespace tactus {

class Digits {
 public:
  /// Notes a number of the column. [any]
  void note(std::string_view number);
  /// Returns half of a unit in the last digit of a number of the column, by which it may differ
  /// from what was to be written. [any]
  double half_unit(double number) const;

 private:
  int decimals_ = 0, significant_ = 0;  // most of any number
};

}  // namespace tactus
