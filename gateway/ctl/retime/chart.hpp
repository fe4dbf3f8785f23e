// Chart: coordinates of positions near a waypoint, in which a straight path at unit speed is a
// straight line, and two that meet in the waypoint make a corner there: of joints their difference
// from it, of the tip its distance and the rotation vector phi, R = R_0 exp(phi).
#pragma once

#include "gateway/ctl/retime/numbers.hpp"

namespace tactus::ctl {

/// A place of a path and its derivatives by s; those of a rotation are the angular velocity and its
/// derivatives in the base frame, per unit of s.
struct PathPlace {
  Numbers q, dq, ddq, dddq;
};

class Chart {
 public:
  Chart() = default;
  Chart(const Numbers& origin, bool tip) : origin_(origin), tip_(tip) {}

  /// Returns the coordinates of a position, of a rotation along the shortest arc. [any]
  Numbers to(const Numbers& position) const;
  /// Returns a place given in coordinates. [any]
  PathPlace from(const PathPlace& coordinates) const;

 private:
  Numbers origin_;
  bool tip_ = false;
};

}  // namespace tactus::ctl
