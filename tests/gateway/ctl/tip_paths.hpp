// Paths of the tip for the tests of retiming, and the bounds of the UR10.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>

#include "gateway/ctl/retime/retimer.hpp"
#include "kernel/core/task_limits.hpp"
#include "kernel/math/so3.hpp"

namespace tactus::ctl {

inline const tactus::TaskLimits kLimits;
inline constexpr double kReserve = 0.98;  // of acceleration and jerk; the rest is for stops

inline Numbers two(double translation, double rotation) {
  return Eigen::Array2d(translation, rotation);
}

inline RetimeSettings settings(bool jerk) {
  RetimeSettings settings;
  settings.tip = true;
  settings.bounds = {two(kLimits.v_max, kLimits.w_max),
                     kReserve * two(kLimits.a_max, kLimits.alpha_max),
                     kReserve * two(kLimits.j_max, kLimits.dalpha_max)};
  settings.jerk = jerk;
  return settings;
}

inline Numbers waypoint(const Vector3& p, const Eigen::Quaterniond& r) {
  Numbers x(7);
  x << p.array(), r.w(), r.x(), r.y(), r.z();
  return x;
}
inline Numbers waypoint(const Vector3& p, const Vector3& phi) {
  return waypoint(p, exp_so3(phi));
}

inline Eigen::Quaterniond orientation(const Numbers& x) {
  return {x[3], x[4], x[5], x[6]};
}

using Random = std::mt19937;
inline double between(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}
inline Vector3 anywhere(Random& random, double most) {
  Vector3 v;
  for (double& number : v) number = between(random, -most, most);
  return v;
}

inline std::vector<Numbers> random_path(Random& random, int trial) {
  std::vector<Numbers> path = {waypoint(anywhere(random, 1.9), exp_so3(anywhere(random, 3.0)))};
  for (int i = 0; i < 1 + trial % 5; ++i) {
    const double far = std::pow(10.0, between(random, -2.0, 0.0));
    const Numbers& last = path.back();
    Vector3 p = last.head<3>();
    Eigen::Quaterniond r = orientation(last);
    const int kind = static_cast<int>(random() % 4);  // 0: turns only; 1: does not turn
    if (kind != 0) p = (p + anywhere(random, 2.0 * far)).cwiseMin(1.9).cwiseMax(-1.9);
    if (kind != 1) r = (r * exp_so3(anywhere(random, 1.8 * far))).normalized();
    path.push_back(waypoint(p, r));
  }
  return path;
}

/// A right angle of the line, and of the axis of the turn.
inline const std::vector<Numbers> kBent = {
    waypoint(Vector3::Zero(), Vector3::Zero()),
    waypoint(Vector3(0.5, 0.0, 0.0), Vector3(0.5, 0.0, 0.0)),
    waypoint(Vector3(0.5, 0.5, 0.0),
             exp_so3(Vector3(0.5, 0.0, 0.0)) * exp_so3(Vector3(0.0, 0.5, 0.0)))};

inline double distance(const Numbers& a, const Numbers& b) {
  return (a - b).head<3>().matrix().norm();
}
inline double angle(const Numbers& a, const Numbers& b) {
  return log_so3(orientation(a).conjugate() * orientation(b)).norm();
}

}  // namespace tactus::ctl
