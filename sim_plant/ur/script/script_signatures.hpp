// The calls of URScript that the interpreter of lines emulates, with their parameters.
#pragma once

#include "sim_plant/ur/script/script_text.hpp"

namespace tactus::ur {

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

}  // namespace tactus::ur
