// The cells of a CSV file: how a row is cut, which numbers it may contain, and the units that a
// header may name in place of SI.
#pragma once

#include <string_view>

#include "kernel/core/load_error.hpp"

namespace tactus {

/// Cuts a row into cells.
class Cells {
 public:
  Cells(std::string_view row, char separator) : row_(row), separator_(separator) {}

  /// Takes the next cell without the blanks around it; false if none is left. [any]
  bool take(std::string_view& cell);

 private:
  std::string_view row_;
  char separator_;
  bool more_ = true;
};

/// Returns what separates the cells of a file: a semicolon or a tab if its header has one. [any]
char separator_of(std::string_view header);

/// Reads a cell; false unless it is a finite decimal number. [any]
bool read_number(std::string_view cell, double& value);

/// Explains a cell that is not a number. [any]
Message not_a_number(std::string_view cell);

/// Explains a header that names no column. [any]
const char* not_a_column(std::string_view header);

/// Returns the header with the SI unit in place of degrees, millimetres or milliseconds, and the SI
/// units in one of the header's. [any]
Name in_si(std::string_view header, double& scale);

}  // namespace tactus
