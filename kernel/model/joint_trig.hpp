// Sine and cosine of every joint angle: computed once per cycle, used by every algorithm.
#pragma once

#include <array>

#include "kernel/math/sincos.hpp"
#include "kernel/model/joint_frames.hpp"

namespace tactus {

template <class R>
using JointTrig = std::array<SinCos, R::kDof>;

/// q in rad; NaN for a joint whose angle sincos() refuses. [cyclic]
template <class R>
JointTrig<R> joint_trig(const JointsOf<R>& q) {
  JointTrig<R> trig;
  for (int i = 0; i < R::kDof; ++i) trig[static_cast<std::size_t>(i)] = sincos(q[i]);
  return trig;
}

}  // namespace tactus
