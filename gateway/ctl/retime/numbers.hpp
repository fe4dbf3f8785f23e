// Numbers of a robot that is known only when the program runs: of its joints or of its tip. Their
// channels have a bound each: a joint is one, and so are the length of a vector of translation and
// that of one of rotation, three numbers each.
//
//           position                         derivatives                       channels
//   joints  rad, one for each                rad/s, ..., one for each          each joint
//   tip     m, then a quaternion w x y z: 7  m/s, ..., then rad/s, ...: 6      two lengths
#pragma once

#include <Eigen/Core>

namespace tactus::ctl {

using Numbers = Eigen::ArrayXd;

/// Returns the lengths of the channels of a derivative, or of a difference. [any]
inline Numbers lengths(const Numbers& vector, Eigen::Index channels) {
  const Eigen::Map<const Eigen::MatrixXd> each(vector.data(), vector.size() / channels, channels);
  return each.colwise().norm().transpose();
}

/// Largest lengths of the channels: rad/s or m/s, and so on.
struct MotionBounds {
  Numbers v, a, j;
};

/// A waypoint of a trajectory; the time in s.
struct TimedPoint {
  double time_s = 0.0;
  Numbers q, dq, ddq;
  double s = 0.0;  ///< from the beginning of its section of the path
};

}  // namespace tactus::ctl
