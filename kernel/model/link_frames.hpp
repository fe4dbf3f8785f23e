// Frames of all links in the base frame: the outward sweep of forward_kinematics.hpp, recorded at
// every joint.
//   R_i = R_(i-1) RotX(roll_i) RotZ(q_i)      p_i = p_(i-1) + R_(i-1) origin_i
#pragma once

#include <array>

#include "kernel/model/forward_kinematics.hpp"

namespace tactus {

/// Axes and origin of a link's frame in the base frame.
struct LinkFrame {
  Matrix3 r = Matrix3::Identity();
  Vector3 p = Vector3::Zero();  ///< m

  /// Returns a point of the link in base coordinates. [any]
  Vector3 at(const Vector3& point) const { return p + r * point; }
};

/// Frame 0 is the base, frame i that of joint i, counted from 1.
template <class R>
using LinkFrames = std::array<LinkFrame, R::kDof + 1>;

/// Fills the frames from joint i up, counted from 0.
template <class R, int i, class A>
void frames_from(const A& parent, const JointTrig<R>& trig, LinkFrames<R>& frames) {
  if constexpr (i < R::kDof) {
    const auto link = turned(rolled_axes<R, i>(parent), trig[i]);
    frames[i + 1].r << dense(link.x), dense(link.y), dense(link.z);
    frames[i + 1].p = frames[i].p + dense(rotated(parent, origin<R, i>(trig)));
    frames_from<R, i + 1>(link, trig, frames);
  }
}

/// Returns the frames of all links. [cyclic]
// flatten: the recursion over the joints becomes one straight line of arithmetic.
template <class R>
[[gnu::flatten]] LinkFrames<R> link_frames(const JointTrig<R>& trig) {
  constexpr auto kBase =
      FrameAxes{TypedVector{1.0, Zero{}, Zero{}}, TypedVector{Zero{}, 1.0, Zero{}},
                TypedVector{Zero{}, Zero{}, 1.0}};
  LinkFrames<R> frames;
  frames_from<R, 0>(kBase, trig, frames);
  return frames;
}

}  // namespace tactus
