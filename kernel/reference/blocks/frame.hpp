// Frame: a constant frame in the base frame, such as that of a table or a wall, in which references
// can be given.
#pragma once

#include "kernel/core/brake.hpp"
#include "kernel/core/describe.hpp"
#include "kernel/core/port.hpp"
#include "kernel/core/status.hpp"
#include "kernel/math/so3.hpp"

namespace tactus {

struct Frame {
  static constexpr const char* kType = "frame";

  struct Params {
    Vector3 position = Vector3::Constant(kRequired);  ///< m, of its origin
    Vector3 rotation = Vector3::Zero();               ///< rad, rotation vector from the base's axes
  } params;
  Out<Quantity::kPose> x;

  template <class Visitor>
  void describe(Visitor& visit) {
    visit.param("position", params.position, Range{-10.0, 10.0}, "m");
    visit.param("rotation", params.rotation, Range{-6.3, 6.3}, "rad");  // refuses degrees
    visit.out("x", x);
  }

  /// [init]
  Status start() {
    x.value = {params.position, exp_so3(params.rotation)};
    return Status::kOk;
  }
  /// Does nothing: the frame is constant. [cyclic]
  Status step(double /*dt_s*/) { return Status::kOk; }
  /// Has no motion of its own. [cyclic]
  void brake(Status /*why*/, BrakeWay /*way*/) {}
};

}  // namespace tactus
