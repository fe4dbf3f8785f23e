// The parameters of a pipeline as texts, for clients: values with as many digits as distinguish
// them from any other, in the words of a pipeline file.
#pragma once

#include "kernel/core/load_error.hpp"
#include "kernel/load/parameter_book.hpp"

namespace tactus {

struct PresentParameter {
  std::string_view section;
  const char *key = "", *unit = "";
  Text<95> range;
  Value value;
  bool tunable = false;
};

/// Returns the number of parameters of a pipeline. [any]
int count_parameters(ParameterBook& book);
/// Writes number `index` of them as a copy of the book has it. False: there is none. [any]
bool parameter_at(ParameterBook& book, ParameterBook::Copy which, int index, PresentParameter& to);

}  // namespace tactus
