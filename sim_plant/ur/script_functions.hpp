// The functions of URScript that have a value and are emulated.
#pragma once

#include "sim_plant/ur/machine.hpp"
#include "sim_plant/ur/script_text.hpp"

namespace tactus::ur {

/// False: the function has no value, or is not emulated, or not with these arguments.
bool call_function(const ScriptCall& call, const Machine& machine, ScriptValue& value);

}  // namespace tactus::ur
