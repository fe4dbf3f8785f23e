// Tracks: a reference as a number of vectors. Each joint is a track with one component; the tip has
// one for its translation and one for its rotation. Limits bound the length of a vector.
#pragma once

#include <array>

#include "kernel/math/so3.hpp"
#include "kernel/reference/space/joint_space.hpp"
#include "kernel/reference/space/task_space.hpp"

namespace tactus {

struct Track {
  Vector3 p = Vector3::Zero();  ///< position; of a rotation, the turn since the cycle before
  Vector3 v = Vector3::Zero(), a = Vector3::Zero();
};
struct TrackLimits {
  Vector3 p_min = Vector3::Constant(-kInfinity), p_max = Vector3::Constant(kInfinity);
  double v = 0.0, a = 0.0, j = 0.0, v_step = 0.0;
  bool turns = false;
};

template <class Space>
struct Tracks;

template <>
struct Tracks<JointSpace> {
  static constexpr int kCount = kDof;
  static constexpr double kStopBeyond = 0.0;
  static constexpr Status kOutside = Status::kPositionLimit;
  static Track of(const JointSpace::Point& now, const JointSpace::Point& /*before*/, int i) {
    return {{now.q[i], 0.0, 0.0}, {now.dq[i], 0.0, 0.0}, {now.ddq[i], 0.0, 0.0}};
  }
  static TrackLimits limits(const JointLimits& of, int i) {
    TrackLimits limits;
    limits.p_min[0] = of.q_min[i];
    limits.p_max[0] = of.q_max[i];
    limits.v = of.dq_max[i];
    limits.a = of.ddq_max[i];
    limits.j = of.dddq_max[i];
    limits.v_step = of.velocity_step[i];
    return limits;
  }
};

template <>
struct Tracks<TaskSpace> {
  static constexpr int kCount = 2;
  /// A stop runs out the acceleration across the velocity with jerk that it takes from the jerk
  /// along it, and ends that much later than judged, m.
  static constexpr double kStopBeyond = 1e-5;
  static constexpr Status kOutside = Status::kWorkspace;
  /// Returns log(r r_before^-1), shorter than half a turn, from the quaternions alone.
  static Vector3 turned(const Eigen::Quaterniond& r, const Eigen::Quaterniond& before) {
    const Eigen::Quaterniond step = r * before.conjugate();
    const double sine = step.vec().norm(), angle = 2.0 * std::atan2(sine, std::abs(step.w()));
    const Vector3 axis = (step.w() < 0.0 ? -1.0 : 1.0) * step.vec();
    return sine > 1e-12 ? Vector3((angle / sine) * axis) : Vector3(2.0 * axis);
  }
  static Track of(const TaskSpace::Point& now, const TaskSpace::Point& before, int i) {
    if (i == 0) return {now.x.p, now.v.head<3>(), now.a.head<3>()};
    return {turned(now.x.r, before.x.r), now.v.tail<3>(), now.a.tail<3>()};
  }
  static TrackLimits limits(const TaskLimits& of, int i) {
    TrackLimits limits;
    limits.turns = i == 1;
    if (!limits.turns) {
      limits.p_min = of.p_min;
      limits.p_max = of.p_max;
    }
    limits.v = limits.turns ? of.w_max : of.v_max;
    limits.a = limits.turns ? of.alpha_max : of.a_max;
    limits.j = limits.turns ? of.dalpha_max : of.j_max;
    limits.v_step = limits.turns ? of.w_step : of.v_step;
    return limits;
  }
};

}  // namespace tactus
