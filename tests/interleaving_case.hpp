// An order of requests: where it begins, what is asked, and in which cycle.
#pragma once

#include "tests/interleaving_model.hpp"

namespace tactus {

inline constexpr int kCycles = 3, kMostAsked = 4;

/// Where a case begins. The generator is brought there by requests of the same kinds.
enum class Begin {
  kOnline,
  kExecuting,
  kBraking,
  kPausing,
  kPaused,
  kWaiting,    ///< for the start time of a trajectory, some cycles ahead
  kRefusing,   ///< while the executive brakes
  kStreaming,  ///< on an open trajectory
  kStarving,   ///< at its end so far
};
inline constexpr std::array<const char*, 9> kBeginWords = {"online",   "executing", "braking",
                                                           "pausing",  "paused",    "waiting",
                                                           "refusing", "streaming", "starving"};

/// Requests in their order, each with the cycle before which it is sent.
struct Case {
  Begin begin;
  int count;
  std::array<Ask, kMostAsked> asks;
  std::array<int, kMostAsked> cycles;
};

}  // namespace tactus
