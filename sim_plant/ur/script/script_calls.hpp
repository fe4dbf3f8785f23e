// Runs the calls of URScript: those of a line, and those with a value.
#pragma once

#include "sim_plant/ur/parts/machine.hpp"
#include "sim_plant/ur/script/script_text.hpp"

namespace tactus::ur {

enum class CallResult : std::uint8_t {
  kDone,        ///< done, or not emulated and without motion
  kMotion,      ///< a motion command has begun
  kWait,        ///< `wait_s` until the next line
  kHalt,        ///< the program ends
  kNoReach,     ///< a runtime exception: no posture reaches the pose
  kOutOfRange,  ///< a runtime exception: `why`
};

struct CallOutcome {
  CallResult result = CallResult::kDone;
  double wait_s = 0.0;
  std::string_view why = {};
};

/// Runs a call of a line. `moves`: the caller may move the arm; a secondary program may not.
CallOutcome run_call(const ScriptCall& call, bool moves, Machine& machine);

/// True for a command that moves the arm or brings it to rest; the program waits until it returns.
bool is_motion(std::string_view name);

/// Returns the bit of Io that "get_..._digital_in(n)" and the like mean; below 0: none.
int digital_bit(const ScriptCall& call);

}  // namespace tactus::ur
