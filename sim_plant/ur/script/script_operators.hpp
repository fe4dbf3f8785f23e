// Applies the operators of URScript to two values.
#pragma once

#include "sim_plant/ur/script/script_text.hpp"

namespace tactus::ur {

ScriptValue truth_value(bool value);
ScriptValue number_value(double value);

/// Computes left = left `word` right. False: these values have no such operator.
bool apply_operator(std::string_view word, const ScriptValue& right, ScriptValue& left);

}  // namespace tactus::ur
