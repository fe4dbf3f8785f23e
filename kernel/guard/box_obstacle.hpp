// Block: a fixed box near the robot, for the collision check. Its output is its pose and size; it
// computes nothing in the cycle.
#pragma once

#include "kernel/core/brake.hpp"
#include "kernel/core/describe.hpp"
#include "kernel/core/port.hpp"
#include "kernel/core/status.hpp"
#include "kernel/math/so3.hpp"

namespace tactus {

struct BoxObstacle {
  static constexpr const char* kType = "box";

  struct Params {
    Vector3 centre = Vector3::Constant(kRequired);  ///< m, in `frame`
    Vector3 size = Vector3::Constant(kRequired);    ///< m, from face to face
    Vector3 rotation = Vector3::Zero();  ///< rad, rotation vector from the axes of `frame`
  } params;
  In<Quantity::kPose> frame;  ///< optional; default: the base
  Out<Quantity::kBox> box;

  template <class Visitor>
  void describe(Visitor& visit) {
    visit.param("centre", params.centre, Range{-10.0, 10.0}, "m");
    visit.param("size", params.size, Range{1e-3, 20.0}, "m");
    visit.param("rotation", params.rotation, Range{-6.3, 6.3}, "rad");  // refuses degrees
    visit.optional("frame", frame);
    visit.out("box", box);
  }

  /// Places the box in its frame; it stays where the frame is now. [init]
  Status start() {
    box.value.pose = {frame->p + frame->r * params.centre, frame->r * exp_so3(params.rotation)};
    box.value.size = params.size;
    return Status::kOk;
  }
  /// No effect: the box does not move. [cyclic]
  Status step(double /*dt_s*/) { return Status::kOk; }
  /// No effect: the block has no motion of its own. [cyclic]
  void brake(Status /*why*/, BrakeWay /*way*/) {}
};

}  // namespace tactus
