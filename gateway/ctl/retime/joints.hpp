// Joints: one number for each joint of a robot that is known only when the program runs.
#pragma once

#include <Eigen/Core>

namespace tactus::ctl {

using Joints = Eigen::ArrayXd;

/// Largest magnitudes: rad/s, rad/s^2, rad/s^3.
struct MotionBounds {
  Joints v, a, j;
};

/// A waypoint of a trajectory: s, rad, rad/s, rad/s^2.
struct TimedPoint {
  double time_s = 0.0;
  Joints q, dq, ddq;
};

}  // namespace tactus::ctl
