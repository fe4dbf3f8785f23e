// The calls and names of URScript that the interpreter of lines knows, with their parameters.
#pragma once

#include <string_view>

#include "sim_plant/ur/script/script_text.hpp"

namespace tactus::ur {

struct CallOutcome;
struct Machine;

/// A call of URScript that the interpreter of lines emulates, and its parameters.
struct ScriptSignature {
  std::string_view name;
  /// Kind and name of each parameter, in order. Kinds: 1 number, 3 list of three, 6 list of six or
  /// pose, s text, * any. "a/b" has two names; a parameter without a name is given by position.
  /// kAnything: whatever is given.
  std::string_view parameters;
  std::size_t required = 0;
};
inline constexpr std::string_view kAnything = "...";

/// A call that a line may make: it acts and is done, or runs and says what comes next; with neither
/// it is a setting that the emulated arm has no use for.
struct LineCall {
  ScriptSignature signature;
  void (*act)(const ScriptCall& call, Machine& machine) = nullptr;
  CallOutcome (*run)(const ScriptCall& call, Machine& machine) = nullptr;
  bool moves = false;  ///< it moves the arm or brings it to rest; the program waits for it
};

/// A function that has a value in expressions; of kind kNothing: none with these arguments.
struct ValueCall {
  ScriptSignature signature;
  ScriptValue (*value)(const ScriptCall& call, const Machine& machine);
};

/// Finds the row of this name; null: it is not emulated. [any]
const LineCall* find_call(std::string_view name);       // script_calls.cpp
const ValueCall* find_function(std::string_view name);  // script_functions.cpp

template <class Row, std::size_t N>
const Row* find_row(const Row (&rows)[N], std::string_view name) {
  for (const Row& row : rows)
    if (row.signature.name == name) return &row;
  return nullptr;
}

/// Returns what is wrong with the arguments of an emulated call, and the word to blame; empty:
/// nothing is. A value of kind kNothing is of every kind. [any]
std::string_view argument_fault(const ScriptCall& call, std::string_view& word);

/// Returns why a motion command cannot have these values of v, a, t and r; empty: it can. [any]
std::string_view range_fault(const ScriptCall& call, const ScriptSignature& signature);

/// True for a function of URScript on a CB3, emulated or not; other names do not exist. [any]
bool is_urscript_function(std::string_view name);
/// True for a word of the language that may precede a bracket.
bool is_urscript_word(std::string_view name);

}  // namespace tactus::ur
