// Expressions of URScript: numbers, truth values, texts, lists and poses, names, calls, elements,
// and the operators + - * / % == != < > <= >= not and or, in the precedence of the script manual.
// As on a CB3, lists are not added element by element.
#pragma once

#include "sim_plant/ur/script/script_text.hpp"

namespace tactus::ur {

struct Machine;

/// The values of names and functions. Without a machine functions have no value, and only literals
/// are read.
///
/// With `strange`, an expression is only read, before its program runs: variables and functions
/// have values of kind kNothing, which every operator takes. A name that is no variable and no
/// function with a value is left in `strange`, or the word of a call whose arguments do not fit,
/// with the `reason`.
struct ScriptScope {
  const ScriptVariables* variables = nullptr;
  const Machine* machine = nullptr;
  std::string_view* strange = nullptr;
  std::string_view* reason = nullptr;  ///< why there is no value, if more is known
  int* work = nullptr;                 ///< grows by the values read, and by kHeavyCall

  bool reads_only() const { return strange != nullptr && reason != nullptr; }
};

/// The work of a call that searches joint positions, in values read.
constexpr int kHeavyCall = 512;

/// Takes an expression off the text. False: there is none, or it has no value here; the text is
/// unchanged.
bool evaluate(std::string_view& text, const ScriptScope& scope, ScriptValue& value);

/// Takes "name(arguments)" off the beginning of a text. False: the text is not such a call, or an
/// argument has no value.
bool read_call(std::string_view& text, const ScriptScope& scope, ScriptCall& call);

}  // namespace tactus::ur
