// The functions of URScript on a CB3, to distinguish names that do not exist from those that are
// not emulated.
#pragma once

#include <string_view>

namespace tactus::ur {

bool is_urscript_function(std::string_view name);
/// True for a word of the language that may precede a bracket.
bool is_urscript_word(std::string_view name);
/// True for a function that a line may call: it is emulated, or a setting that the emulated arm has
/// no use for.
bool is_emulated_call(std::string_view name);
/// True for a function that has a value in expressions.
bool is_emulated_value(std::string_view name);

}  // namespace tactus::ur
