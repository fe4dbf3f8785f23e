// The numbers of a tip as vectors and a quaternion.
#pragma once

#include "gateway/ctl/retime/numbers.hpp"
#include "kernel/core/vectors.hpp"

namespace tactus::ctl {

/// Translation of a tip position or of its derivative.
inline Vector3 translation_of(const Numbers& tip) {
  return tip.head<3>();
}
/// Rotation of the derivative of a tip position.
inline Vector3 rotation_of(const Numbers& tip) {
  return tip.tail<3>();
}
/// Orientation of a tip position.
inline Eigen::Quaterniond orientation_of(const Numbers& tip) {
  return {tip[3], tip[4], tip[5], tip[6]};
}

inline Numbers tip_position(const Vector3& p, const Eigen::Quaterniond& r) {
  Numbers tip(7);
  tip << p.array(), r.w(), r.x(), r.y(), r.z();
  return tip;
}

}  // namespace tactus::ctl
