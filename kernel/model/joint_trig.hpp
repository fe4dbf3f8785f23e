// Sine and cosine of every joint angle, with the turn of its frame: computed once per cycle, used
// by every algorithm.
#pragma once

#include <array>

#include "kernel/core/loop_bound.hpp"
#include "kernel/math/sincos.hpp"
#include "kernel/model/joint_frames.hpp"

namespace tactus {

template <class R>
using JointTrig = std::array<SinCos, R::kDof>;

/// True if a joint frame of the table is turned at q = 0.
template <class R>
constexpr bool has_turns() {
  for (const JointFrame& joint : R::kJoints)
    if (joint.turn != 0.0) return true;
  return false;
}

/// Takes q in rad; NaN for a joint whose angle sincos() refuses. [cyclic]
template <class R>
JointTrig<R> joint_trig(const JointsOf<R>& q) {
  JointTrig<R> trig;
  LoopBound<R::kDof> joints;
  for (int i = 0; i < R::kDof; ++i) {
    joints.tick();
    const auto k = static_cast<std::size_t>(i);
    if constexpr (has_turns<R>()) {
      trig[k] = sincos(R::kJoints[k].turn + q[i]);
    } else {
      trig[k] = sincos(q[i]);
    }
  }
  return trig;
}

}  // namespace tactus
