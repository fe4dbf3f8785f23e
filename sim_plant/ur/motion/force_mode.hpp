// Force mode: the parameters of a program, and the law by which the tool yields. Each compliant
// axis i of the task frame moves, in addition to the program's commands, by
//
//   m dv_i/dt = w_i + f_i - d v_i,   |v_i| <= limit_i,   d = d0 + damping d1
//
// with the wrench w that the tool is to exert and the wrench f on the tool: an admittance, at rest
// if the two cancel; without contact it moves at w / d. For rotations m and d are multiplied by the
// square of an arm's length. The law of a real controller is not published. On the other axes, and
// after the end of force mode, the speed fades with a constant deceleration.
//
// Task frame: 1: y points from the tip to the frame's origin; 2: as given; 3: x is the direction of
// the tip's motion in the frame's x-y plane.
#pragma once

#include "sim_plant/ur/motion/kinematics.hpp"

namespace tactus::ur {

/// The parameters of the law.
struct ForceSettings {
  double mass_kg = 30.0;
  double damping = 300.0;         ///< d0, N s/m
  double full_damping = 20000.0;  ///< d1, N s/m
  double arm_m = 0.2;
  double fade = 1.2;  ///< m/s^2; rad/s^2 over the arm's length
};

inline constexpr double kForceDamping = 0.005;  ///< default

struct ForceMode {
  bool active = false;
  Vector6 task_frame = Vector6::Zero();  ///< pose in the base: m, rotation vector in rad
  Vector6 selection = Vector6::Zero();   ///< 1: compliant
  Vector6 wrench = Vector6::Zero();      ///< N, N m
  int type = 2;                          ///< 1: y to the tip, 2: fixed, 3: x along the motion
  Vector6 limits = Vector6::Zero();      ///< compliant: m/s, rad/s; others: m, rad, 0: none

  bool compliant(int axis) const { return active && selection[axis] == 1.0; }
  /// True if all numbers are finite and the type exists.
  bool valid() const;
};

class ForceLaw {
 public:
  explicit ForceLaw(const ForceSettings& settings) : settings_(settings) {}

  /// Runs one step of `h_s` with the tip, its velocity and the wrench [f; m] on it, base frame.
  /// [cyclic]
  void step(const ForceMode& mode, double damping, const Frame& tip, const Vector3& speed,
            const Vector6& force, double h_s);
  /// Displacement of the tip, about the tip itself, in the axes of the base.
  const Frame& displacement() const { return displacement_; }
  /// Axes of the task frame in the last step, in the base.
  const Matrix3& axes() const { return axes_; }
  bool still() const { return twist_.isZero(0.0); }
  void reset() {
    displacement_ = {};
    twist_.setZero();
  }

 private:
  void turn_axes(const ForceMode& mode, const Frame& tip, const Vector3& speed);

  ForceSettings settings_;
  Frame displacement_;
  Vector6 twist_ = Vector6::Zero();
  Matrix3 axes_ = Matrix3::Identity();
};

}  // namespace tactus::ur
