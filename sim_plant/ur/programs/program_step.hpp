// The result of the two functions of a running program. In every cycle poll() runs its main thread,
// which reads sockets and registers; command() gives the next motion command after the last has
// returned.
#pragma once

#include <cstdint>

namespace tactus::ur {

enum class ProgramStep : std::uint8_t {
  kRunning,  ///< command(): a motion command was given; poll(): the program goes on
  kWaiting,  ///< command(): no motion command in this cycle
  kEnded,
};

}  // namespace tactus::ur
