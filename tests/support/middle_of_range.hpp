// Where the joints have room on both sides, and which turn, for tests.
#pragma once

#include "kernel/core/joint_limits.hpp"

namespace tactus {

inline JointVector middle_of_range() {
  const JointLimits limits;
  return 0.5 * (limits.q_min + limits.q_max);
}

/// The first joint that turns.
inline constexpr int kFirstRevolute = is_prismatic<Robot>(0) ? 1 : 0;
static_assert(!is_prismatic<Robot>(kFirstRevolute),
              "choose another joint for the tests that turn one");

}  // namespace tactus
