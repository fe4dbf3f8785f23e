// Where the joints have room on both sides, for tests.
#pragma once

#include "kernel/core/joint_limits.hpp"

namespace tactus {

inline JointVector middle_of_range() {
  const JointLimits limits;
  return 0.5 * (limits.q_min + limits.q_max);
}

}  // namespace tactus
