// The calls of a script that move the arm, and those that change how it is moved.
#pragma once

#include "sim_plant/ur/script_calls.hpp"

namespace tactus::ur {

/// A command that moves the arm, or brings it to rest: the program waits until it returns.
bool is_motion(std::string_view name);
CallResult run_motion(const ScriptCall& call, Machine& machine);

/// Force mode, freedrive, and the watchdogs of inputs. False: the call is none of them.
bool run_mode_call(const ScriptCall& call, Machine& machine);

}  // namespace tactus::ur
