// BrakeWay: how the blocks come to rest when the executive brakes them (kernel/cycle/ladder.hpp
// gives the way for each cause). Every block has
//
//   void brake(Status why, BrakeWay way);   // [cyclic]
//
// The executive calls it before step() in every cycle in which it brakes or holds, and in every
// cycle in which the drives are armed or disabled. From then on, until the next start() or
// resume(), the block brings its own motion to rest within limits and keeps it at rest; a block
// that only follows its inputs has an empty brake(). A block without brake() does not compile.
//
// A block with a motion of its own reports when that has come to rest:
//
//   bool at_rest() const;                     // [between two cycles]
//
// An arm that holds a load is held by a command that differs from what is measured. A block whose
// command would step if it started from the measured state also has
//
//   Status resume();                          // [init]
//
// The executive calls it, instead of start(), when a braked arm that has come to rest is to move
// again: the block continues from the command that it sends.
#pragma once

#include <cstdint>

namespace tactus {

enum class BrakeWay : std::uint8_t {
  kOnPath,  ///< the references stop on their path, and the chain follows them
  kAtOnce,  ///< every joint stops as fast as its acceleration allows, off the path
};

}  // namespace tactus
