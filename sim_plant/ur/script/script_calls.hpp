// Runs one call of an emulated URScript function.
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

/// `moves`: the caller may move the arm; a secondary program may not.
CallOutcome run_call(const ScriptCall& call, bool moves, Machine& machine);

}  // namespace tactus::ur
