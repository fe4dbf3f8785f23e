// Where the joints can be while the arm is brought to rest.
//
// Until braking begins, the reaction time t_r from now, joint j moves with |ddq_j| <= a_j. From
// then on its speed falls at least as fast as a ramp that ends with those of all other joints after
//   t_s = max over j of (|dq_j| + a_j t_r) / b_j,    b_j the deceleration of joint j.
// Both ways to stop are within that: each joint by itself with b_j or more, and all together along
// a straight line in joint space. So, with v the speed dq, joint j is above neither of
//   U(t) = q + v t + a t^2 / 2                                 until t_r
//   U(t) = U(t_r) + max(0, v + a t_r) t_s phi / 2              then, phi = 1 - (1 - (t - t_r) /
//   t_s)^2
// and, mirrored, not below L(t). The time until t_r is one section; the rest is cut into kSections
// of equal way, phi = k / kSections. U is convex in the first and rises in the others: its largest
// value in a section is at one end.
#pragma once

#include <array>

#include "kernel/types.hpp"

namespace tactus {

struct Braking {
  double reaction_s = 0.0;                         ///< from the measurement until braking begins
  JointVector acceleration = JointVector::Zero();  ///< a, rad/s^2: most before braking begins
  JointVector deceleration = JointVector::Zero();  ///< b, rad/s^2, > 0
};

/// All joint positions of a section: middle +- half, joint by joint, rad.
struct JointBox {
  JointVector middle, half;
};

inline constexpr int kSections = 4;
using StoppingBoxes = std::array<JointBox, 1 + kSections>;

/// The boxes of all sections, for q in rad and dq in rad/s. [cyclic]
StoppingBoxes stopping_boxes(const Braking& braking, const JointVector& q, const JointVector& dq);

}  // namespace tactus
