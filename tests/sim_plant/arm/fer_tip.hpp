// FerTip: position, axes and Jacobian of a point fixed to the FER's flange, computed by Orocos KDL.
#pragma once

#include <Eigen/Cholesky>

#include "kernel/core/types.hpp"
#include "tests/oracles/kdl.hpp"

namespace tactus {

struct FerTip {
  Vector3 p;                                          // m, base frame
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor> axes;  // of the flange, base frame
  Eigen::Matrix<double, 3, kDof> J;                   // v = J dq
  Eigen::Matrix<double, 6, kDof, Eigen::RowMajor> flange_J;

  /// `tip` in the flange frame, m.
  FerTip(const JointVector& q, const Vector3& tip) {
    double flange[3], r[3][3], jacobian[6][7];
    kdl_flange(q.data(), flange, r);
    kdl_jacobian(q.data(), jacobian);
    axes = Eigen::Map<const decltype(axes)>(r[0]);
    flange_J = Eigen::Map<const decltype(flange_J)>(jacobian[0]);
    const Vector3 lever = axes * tip;
    p = Eigen::Map<const Vector3>(flange) + lever;
    for (int i = 0; i < kDof; ++i) {
      const Vector3 w = flange_J.col(i).tail<3>();
      J.col(i) = flange_J.col(i).head<3>() + w.cross(lever);
    }
  }
  /// The smallest joint motion that moves the tip by `way`, m.
  JointVector joints(const Vector3& way) const {
    return J.transpose() * (J * J.transpose()).ldlt().solve(way);
  }
};

}  // namespace tactus
