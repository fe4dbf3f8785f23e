// The arm's capsules as the collision check counts them: those of the robot's table in order, then
// the tool; and which pairs of them it checks.
#pragma once

#include <array>

#include "kernel/core/types.hpp"

namespace tactus {

/// The tool counts as the body after the last link, and moves with it.
inline constexpr int kToolBody = kDof + 1;

inline constexpr int kTableCapsules = static_cast<int>(RobotCapsules::kCapsules.size());
inline constexpr int kArmCapsules = kTableCapsules + 1;

/// Returns the body of a capsule: the number of its link, or kToolBody. [any]
constexpr int body_of(int capsule) {
  return capsule < kTableCapsules ? RobotCapsules::kCapsules[static_cast<std::size_t>(capsule)].link
                                  : kToolBody;
}

/// True if the pair is listed. [any]
template <class Pair, std::size_t n>
constexpr bool is_in(const std::array<Pair, n>& pairs, int first, int second) {
  for (std::size_t i = 0; i < n; ++i)
    if (pairs[i].first == first && pairs[i].second == second) return true;
  return false;
}

/// True if two of the arm's capsules, the lower number first, are checked: not on one link or on
/// neighbours, not always touching and not always apart. [any]
constexpr bool can_meet(int first, int second) {
  const int one = body_of(first), other = body_of(second);
  return other - one >= 2 && !is_in(RobotCapsules::kTouching, one, other) &&
         !is_in(RobotCapsules::kNever, first, second);
}

/// Returns the number of pairs that can meet. [any]
constexpr int count_pairs() {
  int count = 0;
  for (int second = 1; second < kArmCapsules; ++second)
    for (int first = 0; first < second; ++first) count += can_meet(first, second) ? 1 : 0;
  return count;
}

}  // namespace tactus
