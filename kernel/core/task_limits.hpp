// TaskLimits: the bounds of task-space references for their admission. The numbers come from the
// robot table; a pipeline file may tighten them, never widen them.
#pragma once

#include <algorithm>

#include "kernel/core/describe.hpp"
#include "kernel/core/types.hpp"

namespace tactus {

/// Limits of the tool tip in the base frame. Each maximum bounds the length of a vector.
struct TaskLimits {
  Vector3 p_min = Vector3::Constant(-kWorkspace_m);  ///< m
  Vector3 p_max = Vector3::Constant(kWorkspace_m);   ///< m
  double v_max = Robot::kTaskLimit.v_max;            ///< m/s
  double a_max = Robot::kTaskLimit.a_max;            ///< m/s^2
  double j_max = Robot::kTaskLimit.j_max;            ///< m/s^3
  double w_max = Robot::kTaskLimit.w_max;            ///< rad/s
  double alpha_max = Robot::kTaskLimit.alpha_max;    ///< rad/s^2
  double dalpha_max = Robot::kTaskLimit.dalpha_max;  ///< rad/s^3
  double v_step = 0.25 * Robot::kTaskLimit.v_max;    ///< m/s, between two straight segments
  double w_step = 0.25 * Robot::kTaskLimit.w_max;    ///< rad/s, between two straight segments
  double force_max = Robot::kTaskLimit.force_max;    ///< N, of a feed-forward wrench
  double moment_max = Robot::kTaskLimit.moment_max;  ///< N m, of a feed-forward wrench

  /// The loader refuses a box whose minimum is above its maximum.
  template <class Visitor>
  void describe(Visitor& visit) {
    const TaskLimits robot;
    visit.param("min_position", p_min, Range{-kWorkspace_m, kWorkspace_m}, "m");
    visit.param("max_position", p_max, Range{-kWorkspace_m, kWorkspace_m}, "m");
    visit.param("max_velocity", v_max, up_to(robot.v_max), "m/s");
    visit.param("max_acceleration", a_max, up_to(robot.a_max), "m/s^2");
    visit.param("max_jerk", j_max, up_to(robot.j_max), "m/s^3");
    visit.param("max_angular_velocity", w_max, up_to(robot.w_max), "rad/s");
    visit.param("max_angular_acceleration", alpha_max, up_to(robot.alpha_max), "rad/s^2");
    visit.param("max_angular_jerk", dalpha_max, up_to(robot.dalpha_max), "rad/s^3");
    visit.param("max_velocity_step", v_step, up_to(robot.v_step), "m/s");
    visit.param("max_angular_velocity_step", w_step, up_to(robot.w_step), "rad/s");
    visit.param("max_force", force_max, up_to(robot.force_max), "N");
    visit.param("max_moment", moment_max, up_to(robot.moment_max), "N m");
  }

  /// Returns these limits with velocities of at most `speed`, m/s and rad/s. [any]
  TaskLimits slowed(double speed) const {
    TaskLimits limits = *this;
    limits.v_max = std::min(v_max, speed);
    limits.w_max = std::min(w_max, speed);
    return limits;
  }

 private:
  static constexpr Range up_to(double maximum) { return {kPositive.lo, maximum}; }
};

}  // namespace tactus
