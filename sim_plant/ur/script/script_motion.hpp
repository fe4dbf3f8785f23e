// The calls of a script that move the arm, and those that change how it moves.
#pragma once

#include "sim_plant/ur/script/script_calls.hpp"

namespace tactus::ur {

/// True for a command that moves the arm or brings it to rest; the program waits until it returns.
bool is_motion(std::string_view name);
CallResult run_motion(const ScriptCall& call, Machine& machine);

/// Runs a call for force mode, freedrive or the watchdogs of inputs. False: the call is none of
/// them.
bool run_mode_call(const ScriptCall& call, Machine& machine);

}  // namespace tactus::ur
