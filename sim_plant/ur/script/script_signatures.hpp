// The calls and names of URScript that the interpreter of lines knows, with their parameters.
#pragma once

#include <string_view>

#include "sim_plant/ur/script/script_text.hpp"

namespace tactus::ur {

/// The calls of URScript that the interpreter of lines emulates, with their parameters.
struct ScriptSignature {
  enum class Use : std::uint8_t { kLine, kValue, kIgnored };
  Use use = Use::kLine;
  std::string_view name;
  /// Kind and name of each parameter, in order. Kinds: 1 number, 3 list of three, 6 list of six or
  /// pose, s text, * any. "a/b" has two names; a parameter without a name is given by position.
  std::string_view parameters;
  std::size_t required = 0;
};

/// Null: the call is not emulated. [any]
const ScriptSignature* find_signature(std::string_view name);

/// Returns what is wrong with the arguments of an emulated call, and the word to blame; empty:
/// nothing is. A value of kind kNothing is of every kind. [any]
std::string_view argument_fault(const ScriptCall& call, std::string_view& word);

/// Returns why a motion command cannot have these values of v, a, t and r; empty: it can. [any]
std::string_view range_fault(const ScriptCall& call);

// The functions of URScript on a CB3, to distinguish names that do not exist from those that are
// not emulated.

bool is_urscript_function(std::string_view name);
/// True for a word of the language that may precede a bracket.
bool is_urscript_word(std::string_view name);
/// True for a function that a line may call: it is emulated, or a setting that the emulated arm has
/// no use for.
bool is_emulated_call(std::string_view name);
/// True for a function that has a value in expressions.
bool is_emulated_value(std::string_view name);

}  // namespace tactus::ur
