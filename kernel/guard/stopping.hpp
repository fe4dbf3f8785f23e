// The positions that the joints can take while the arm is brought to rest.
//
// Until braking begins, after the reaction time t_r, joint j moves with |ddq_j| <= a_j. Let v be
// its velocity at that time and s the time from then on. Its speed is then between two ramps,
//   |v| - b_j s       to zero: each joint stops separately, as fast as it can, and
//   |v| (1 - s/t_s)   all stop together, on a straight line in joint space if a_j = 0,
// where t_s = max over j of (|dq_j| + a_j t_r) / b_j is the time of the slowest joint. With the
// ways
//   own(v, s)    = v s - sign(v) b_j s^2 / 2, that is at most v |v| / (2 b_j)
//   common(v, s) = v (s - s^2 / (2 t_s))
// which rise with v, joint j is not above
//   U(t) = q + dq t + a t^2 / 2                                until t_r
//   U(t) = U(t_r) + (own if v < 0, else common)(v, t - t_r),   v = dq + a t_r
// and, mirrored, not below L(t). The time until t_r is one section; the rest is divided into
// kBrakes of equal way on the common ramp. U is convex in the first section and monotone in the
// others, so its largest value in a section is at one end.
#pragma once

#include "kernel/core/types.hpp"

namespace tactus {

struct Braking {
  double reaction_s = 0.0;  ///< t_r: from the measurement until braking begins
  JointVector acceleration = JointVector::Zero();  ///< a, rad/s^2: largest until braking begins
  JointVector deceleration = JointVector::Zero();  ///< b, rad/s^2, > 0
};

/// All joint positions of a section: middle +- half, joint by joint, rad.
struct JointBox {
  JointVector middle, half;
};

/// The sections of the way from the measurement until rest: one before braking, then kBrakes.
inline constexpr int kBrakes = 8;
inline constexpr int kSections = 1 + kBrakes;

/// Returns the box of section 0 .. kSections - 1, for q in rad and dq in rad/s. [cyclic]
JointBox stopping_box(const Braking& braking, const JointVector& q, const JointVector& dq,
                      int section);

/// Returns how far each joint gets from where it is, at most, until it rests, rad: a bound for all
/// sections. [cyclic]
JointVector stopping_range(const Braking& braking, const JointVector& dq);

}  // namespace tactus
