// Sine and cosine of every joint angle: computed once per cycle, used by every algorithm.
#pragma once

#include <array>

#include "kernel/core/loop_bound.hpp"
#include "kernel/math/sincos.hpp"
#include "kernel/model/joint_frames.hpp"

namespace tactus {

template <class R>
using JointTrig = std::array<SinCos, R::kDof>;

/// Takes q in rad; NaN for a joint whose angle sincos() refuses. [cyclic]
template <class R>
JointTrig<R> joint_trig(const JointsOf<R>& q) {
  JointTrig<R> trig;
  LoopBound<R::kDof> joints;
  for (int i = 0; i < R::kDof; ++i) {
    joints.tick();
    trig[static_cast<std::size_t>(i)] = sincos(q[i]);
  }
  return trig;
}

}  // namespace tactus
