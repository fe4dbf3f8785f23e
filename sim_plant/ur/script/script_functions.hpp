// The emulated URScript functions that return a value.
#pragma once

#include "sim_plant/ur/parts/machine.hpp"
#include "sim_plant/ur/script/script_text.hpp"

namespace tactus::ur {

/// Calls a function. False: it has no value, or is not emulated with these arguments.
bool call_function(const ScriptCall& call, const Machine& machine, ScriptValue& value);

}  // namespace tactus::ur
