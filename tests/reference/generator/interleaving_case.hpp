// Case: an order of requests, with the state in which it begins and the cycle of each request.
#pragma once

#include "tests/reference/generator/interleaving_model.hpp"

namespace tactus {

inline constexpr int kCycles = 3, kMostAsked = 4;

/// The state in which a case begins. Requests of the same kinds bring the generator there.
enum class Begin {
  kOnline,
  kExecuting,
  kBraking,
  kPausing,
  kPaused,
  kWaiting,    ///< for the start time of a trajectory, some cycles ahead
  kRefusing,   ///< while the executive brakes
  kStreaming,  ///< on an open trajectory
  kStarving,   ///< at the present end of an open trajectory
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
