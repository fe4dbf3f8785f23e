// Sine and cosine of every joint angle, with the turn of its frame, and the travel of prismatic
// joints: computed once per cycle, used by every algorithm.
#pragma once

#include <array>
#include <type_traits>

#include "kernel/core/loop_bound.hpp"
#include "kernel/math/sincos.hpp"
#include "kernel/model/joint_frames.hpp"

namespace tactus {

/// True if a joint frame of the table is turned at q = 0.
template <class R>
constexpr bool has_turns() {
  for (const JointFrame& joint : R::kJoints)
    if (joint.turn != 0.0) return true;
  return false;
}

/// Positions of the joints, of which those of prismatic ones are read.
template <class R>
struct Travel {
  JointsOf<R> q;
};
struct NoTravel {};

template <class R>
struct JointTrig : std::array<SinCos, R::kDof>,
                   std::conditional_t<has_prismatic<R>(), Travel<R>, NoTravel> {};

/// Takes q in rad, of prismatic joints in m; NaN for a joint whose angle sincos() refuses. [cyclic]
template <class R>
JointTrig<R> joint_trig(const JointsOf<R>& q) {
  JointTrig<R> trig;
  if constexpr (has_prismatic<R>()) trig.q = q;
  LoopBound<R::kDof> joints;
  for (int i = 0; i < R::kDof; ++i) {
    joints.tick();
    const auto k = static_cast<std::size_t>(i);
    if constexpr (has_prismatic<R>()) {
      trig[k] = sincos(R::kJoints[k].turn + (is_prismatic<R>(i) ? 0.0 : q[i]));
    } else if constexpr (has_turns<R>()) {
      trig[k] = sincos(R::kJoints[k].turn + q[i]);
    } else {
      trig[k] = sincos(q[i]);
    }
  }
  return trig;
}

/// Returns the origin of frame i in the axes of frame i-1, m. [any]
template <class R, int i>
auto origin([[maybe_unused]] const JointTrig<R>& trig) {
  if constexpr (is_prismatic<R>(i)) {
    const TypedVector travel{Zero{}, Zero{}, trig.q[i]};
    return offset<R, i>() + rolled<R, i>(travel);
  } else {
    return offset<R, i>();
  }
}

}  // namespace tactus
