// Blocks: fixed bodies near the robot, for the collision check. The output is the box in which a
// body is, and what is inside it; nothing is computed in the cycle.
#pragma once

#include "kernel/core/brake.hpp"
#include "kernel/core/describe.hpp"
#include "kernel/core/port.hpp"
#include "kernel/core/status.hpp"
#include "kernel/guard/convex.hpp"
#include "kernel/math/so3.hpp"

namespace tactus {

/// Form has the settings of a shape in describe(), and gives the size of its box and what is inside
/// by close().
template <class Form>
struct Obstacle {
  struct Params {
    Vector3 centre = Vector3::Constant(Form::kCentre);  ///< m, in `frame`
    Form form;
    Vector3 rotation = Vector3::Zero();  ///< rad, rotation vector from the axes of `frame`
  } params;
  In<Quantity::kPose> frame;  ///< optional; default: the base
  Out<Quantity::kBox> box;

  template <class Visitor>
  void describe(Visitor& visit) {
    visit.param("centre", params.centre, Range{-10.0, 10.0}, "m");
    params.form.describe(visit);
    visit.param("rotation", params.rotation, Range{-6.3, 6.3}, "rad");  // refuses degrees
    visit.optional("frame", frame);
    visit.out("box", box);
  }

  /// Places the body in its frame; it stays where the frame is now. [init]
  Status start() {
    box.value.pose = {frame->p + frame->r * params.centre, frame->r * exp_so3(params.rotation)};
    params.form.close(box.value);
    return Status::kOk;
  }
  /// No effect: the body does not move. [cyclic]
  Status step(double /*dt_s*/) { return Status::kOk; }
  /// No effect: the block has no motion of its own. [cyclic]
  void brake(Status /*why*/, BrakeWay /*way*/) {}
};

struct BoxForm {
  static constexpr double kCentre = kRequired;
  Vector3 size = Vector3::Constant(kRequired);  ///< m, from face to face

  template <class Visitor>
  void describe(Visitor& visit) {
    visit.param("size", size, Range{1e-3, 20.0}, "m");
  }
  void close(Cuboid& box) { box.size = size; }
};
struct BoxObstacle : Obstacle<BoxForm> {
  static constexpr const char* kType = "box";
};

struct SphereForm {
  static constexpr double kCentre = kRequired;
  double radius = kRequired;  ///< m
  Convex inside;

  template <class Visitor>
  void describe(Visitor& visit) {
    visit.param("radius", radius, Range{1e-3, 10.0}, "m");
  }
  void close(Cuboid& box) {
    inside.rounding = radius;
    box.size.setConstant(2.0 * radius);
    box.inside = &inside;
  }
};
struct SphereObstacle : Obstacle<SphereForm> {
  static constexpr const char* kType = "sphere";
};

/// Along z, with the flat ends of a cylinder or the round ends of a capsule.
template <Convex::Core core>
struct RodForm {
  static constexpr bool kRound = core == Convex::Core::kBox;
  static constexpr double kCentre = kRequired;
  double radius = kRequired;  ///< m
  double length = kRequired;  ///< m, of a capsule without its round ends
  Convex inside;

  template <class Visitor>
  void describe(Visitor& visit) {
    visit.param("radius", radius, Range{1e-3, 10.0}, "m");
    visit.param("length", length, Range{1e-3, 20.0}, "m");
  }
  void close(Cuboid& box) {
    const double across = kRound ? 0.0 : radius;
    inside.core = core;
    inside.half = {across, across, 0.5 * length};
    inside.rounding = kRound ? radius : 0.0;
    box.size = {2.0 * radius, 2.0 * radius, length + 2.0 * inside.rounding};
    box.inside = &inside;
  }
};
struct CapsuleObstacle : Obstacle<RodForm<Convex::Core::kBox>> {
  static constexpr const char* kType = "capsule";
};
struct CylinderObstacle : Obstacle<RodForm<Convex::Core::kCylinder>> {
  static constexpr const char* kType = "cylinder";
};

/// The convex hull of points, and all that is within `rounding` of it.
struct ConvexForm {
  static constexpr double kCentre = 0.0;
  struct Points : Hull {
    static constexpr int kLeast = 1;
  } points;               ///< from `centre`
  double rounding = 0.0;  ///< m
  Convex inside;

  template <class Visitor>
  void describe(Visitor& visit) {
    visit.lines("point", points, "x y z, x y z: of the hull, from centre, m");
    visit.param("rounding", rounding, Range{0.0, 1.0}, "m");
  }
  void close(Cuboid& box) {
    box.size = inside.take(points) + Vector3::Constant(2.0 * rounding);
    inside.rounding = rounding;
    box.pose.p += box.pose.r * inside.middle;
    box.inside = &inside;
  }
};
struct ConvexObstacle : Obstacle<ConvexForm> {
  static constexpr const char* kType = "convex";
};

}  // namespace tactus
