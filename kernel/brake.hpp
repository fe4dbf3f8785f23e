// BrakeWay: how the chain comes to rest when the executive brakes it (kernel/ladder.hpp says which
// way for which cause). Every block has
//
//   void brake(Status why, BrakeWay way);   // [cyclic]
//
// which the executive calls before step() in every cycle in which it brakes, holds, or the drives
// are disabled. From then on, until the next start(), a block ends what motion of its own it has
// within limits and stays at rest; one that only follows its inputs has an empty brake(). A block
// without one does not compile.
#pragma once

#include <cstdint>

namespace tactus {

enum class BrakeWay : std::uint8_t {
  kOnPath,  ///< the references stop on their path, and the chain follows them
  kAtOnce,  ///< every joint stops as fast as its acceleration allows; the path is left
};

}  // namespace tactus
