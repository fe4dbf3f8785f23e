// The functions of URScript that are emulated, one call at a time.
#pragma once

#include "sim_plant/ur/machine.hpp"
#include "sim_plant/ur/script_text.hpp"

namespace tactus::ur {

enum class CallResult : std::uint8_t {
  kDone,     ///< or not emulated, which moves nothing
  kMotion,   ///< a motion command has begun
  kWait,     ///< `wait_s` until the next line
  kHalt,     ///< the program ends
  kNoReach,  ///< a runtime exception: there is no such posture
};

struct CallOutcome {
  CallResult result = CallResult::kDone;
  double wait_s = 0.0;
};

/// A command that moves the arm, or brings it to rest.
bool is_motion(std::string_view name);

/// `moves`: the caller may move the arm; a secondary program may not.
CallOutcome run_call(const ScriptCall& call, bool moves, Machine& machine);

}  // namespace tactus::ur
