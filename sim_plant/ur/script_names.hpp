// The functions of URScript on a CB3, so that a name that does not exist is told from one that is
// only not emulated.
#pragma once

#include <string_view>

namespace tactus::ur {

bool is_urscript_function(std::string_view name);
/// A word of the language that may stand before a bracket.
bool is_urscript_word(std::string_view name);

/// Where a program calls what does not exist: line and column from 1, and the name. False: nowhere.
struct UnknownName {
  int line = 0, column = 0;
  std::string_view name;
};
bool find_unknown_name(std::string_view program, UnknownName& unknown);

}  // namespace tactus::ur
