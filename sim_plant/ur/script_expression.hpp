// Expressions of URScript: numbers, truth values, texts, lists and poses, names, calls, elements,
// and the operators + - * / % == != < > <= >= not and or, in the precedence of the script manual.
// Lists are not added element by element: a CB3 does not do that either.
#pragma once

#include "sim_plant/ur/script_text.hpp"

namespace tactus::ur {

struct Machine;

/// What names and functions stand for. Without a machine no function has a value: then only what is
/// written out is read.
struct ScriptScope {
  const ScriptVariables* variables = nullptr;
  const Machine* machine = nullptr;
};

/// Takes an expression off the text. False: it is none, or has no value here; the text is as it
/// was.
bool evaluate(std::string_view& text, const ScriptScope& scope, ScriptValue& value);

/// Reads "name(arguments)" at the beginning of a text and takes it off; false: the text is no such
/// call, or an argument has no value.
bool read_call(std::string_view& text, const ScriptScope& scope, ScriptCall& call);

}  // namespace tactus::ur
