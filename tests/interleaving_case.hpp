// An order of requests: where it begins, what is asked, and in which cycle.
#pragma once

#include "tests/interleaving_model.hpp"

namespace tactus {

inline constexpr int kCycles = 3, kMostAsked = 4;

/// Where a case begins. The generator is brought there by requests of the same kinds.
enum class Begin { kOnline, kExecuting, kBraking, kPausing, kPaused };
inline constexpr Begin kBegins[] = {Begin::kOnline, Begin::kExecuting, Begin::kBraking,
                                    Begin::kPausing, Begin::kPaused};
inline constexpr std::array<const char*, 5> kBeginWords = {"online", "executing", "braking",
                                                           "pausing", "paused"};

/// Requests in their order, each with the cycle in which it is answered.
struct Case {
  Begin begin;
  int count;
  std::array<Ask, kMostAsked> asks;
  std::array<int, kMostAsked> cycles;
};

}  // namespace tactus
