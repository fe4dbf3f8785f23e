// Blend: the path past a waypoint P from a segment A to the next, B, over u from 0 to 1. What is
// left of A shrinks as what is gone of B grows,
//
//   left(u) = dA (1 - u)^2 (1 + k u),   gone(u) = dB u^2 (1 + k (1 - u)),
//
// and the two run at once: q = A + B - P in the joints, where one of the segments is in them, else
// p = A + B - P and R = RA RP' RB of the tool. With k = 0 two lines make a parabola of constant
// acceleration. Position and velocity are continuous at both ends, and the path lies between the
// corner and the two lines: within the radius of P.
//
// Between two lines of movep the tool goes round the circle that touches both at the distance e
// from P, rho = e / tan(theta / 2), at constant speed; k = 2 - theta rho / e makes the tool turn
// as continuously.
#pragma once

#include "sim_plant/ur/segment.hpp"

namespace tactus::ur {

class Blend final : public Curve {
 public:
  /// From `left` before the end of `a` to `gone` on `b`, by their x. Both outlive the blend. [any]
  void start(const Segment& a, double left, const Segment& b, double gone);

  double length() const override { return 1.0; }
  bool at(double u, const Joints& near, Joints& q, Joints& slope) const override;

  /// The way of the segments at the ends, by u: what du/dt makes dx/dt.
  double entry() const { return (2.0 - k_) * left_; }
  double exit() const { return (2.0 - k_) * gone_; }
  double left() const { return left_; }
  double gone() const { return gone_; }
  /// The largest du/dt with which the acceleration stays below `a_first`; of two moves of which
  /// one is in the joints, that of each below its own.
  double rate(double a_first, double a_next) const;
  bool keeps_speed() const { return circle_; }

 private:
  /// Of A and B at u: x, and dx/du.
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
