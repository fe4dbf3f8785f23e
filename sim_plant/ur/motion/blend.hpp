// Blend: the path past a waypoint P from a segment A to the next, B, over u from 0 to 1. The
// distance left on A shrinks while the distance gone on B grows,
//
//   left(u) = dA (1 - u)^2 (1 + k u),   gone(u) = dB u^2 (1 + k (1 - u)),
//
// and both run at the same time: q = A + B - P in the joints if one of the segments is in the
// joints, otherwise p = A + B - P and R = RA RP' RB for the tool. With k = 0 two lines make a
// parabola of constant acceleration. Position and velocity are continuous at both ends, and the
// path stays between the corner and the two lines, within the radius of P.
//
// Between two lines of movep the tool follows the circle that touches both at the distance e from
// P, rho = e / tan(theta / 2), at constant speed; k = 2 - theta rho / e makes the turn of the tool
// continuous too.
#pragma once

#include "sim_plant/ur/motion/segment.hpp"

namespace tactus::ur {

class Blend final : public Curve {
 public:
  /// Blends from `left` before the end of `a` to `gone` on `b`, by their x. Both must outlive the
  /// blend. [any]
  void start(const Segment& a, double left, const Segment& b, double gone);

  double length() const override { return 1.0; }
  bool at(double u, const Joints& near, Joints& q, Joints& slope) const override;

  /// dx/du of the segments at entry and exit.
  double entry() const { return (2.0 - k_) * left_; }
  double exit() const { return (2.0 - k_) * gone_; }
  double left() const { return left_; }
  double gone() const { return gone_; }
  /// Returns the largest du/dt for which the acceleration stays below `a_first`; if one of the
  /// moves is in the joints, for which each move stays below its own acceleration.
  double rate(double a_first, double a_next) const;
  bool keeps_speed() const { return circle_; }

 private:
  /// x and dx/du of A and B at u.
  struct Share {
    double x_a, dx_a, x_b, dx_b;
  };
  Share share(double u) const;
  void fit_circle();
  bool at_joints(double u, Joints& q, Joints& slope) const;
  Frame tip(double u, Vector6& twist) const;

  const Segment* a_ = nullptr;
  const Segment* b_ = nullptr;
  double left_ = 0.0, gone_ = 0.0, k_ = 0.0;
  bool circle_ = false;
  Vector3 touch_ = Vector3::Zero(), along_ = Vector3::Zero(), across_ = Vector3::Zero();
  double theta_ = 0.0, rho_ = 0.0;
};

}  // namespace tactus::ur
