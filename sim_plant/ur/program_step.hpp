// The two halves of a running program. In every cycle poll() does what its main thread does: it
// reads sockets and registers. command() is asked for the next motion command when the last has
// returned.
#pragma once

#include <cstdint>

namespace tactus::ur {

enum class ProgramStep : std::uint8_t {
  kRunning,  ///< command(): a motion command was given; poll(): carry on
  kWaiting,  ///< command(): none in this cycle
  kEnded,
};

}  // namespace tactus::ur
