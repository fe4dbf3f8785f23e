// The functions of URScript on a CB3, to distinguish names that do not exist from those that are
// not emulated.
#pragma once

#include <string_view>

namespace tactus::ur {

bool is_urscript_function(std::string_view name);
/// True for a word of the language that may precede a bracket.
bool is_urscript_word(std::string_view name);

/// A call of a function that does not exist: line and column from 1, and the name.
struct UnknownName {
  int line = 0, column = 0;
  std::string_view name;
};
bool find_unknown_name(std::string_view program, UnknownName& unknown);

}  // namespace tactus::ur
