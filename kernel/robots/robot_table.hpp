// The types of a robot's table of constants, which fer.hpp and ur10.hpp fill in. They say nothing
// about how the table is used.
#pragma once

namespace tactus {

/// A revolute joint turns about its own z, a prismatic one moves along it.
enum class JointType { kRevolute, kPrismatic };

/// Placement of joint frame i in joint frame i-1:
///   T(i-1, i) = Trans(x, y, z) RotX(roll) RotZ(turn + q_i)                 revolute
///   T(i-1, i) = Trans(x, y, z) RotX(roll) RotZ(turn) Trans(0, 0, q_i)      prismatic
/// where roll is a number of quarter turns, and a tilt where neighbouring axes are neither parallel
/// nor perpendicular. The flange has no turn.
struct JointFrame {
  double x, y, z;          ///< m, in frame i-1
  int roll_quarter_turns;  ///< roll about x in units of pi/2: -1, 0, 1 or 2
  double turn = 0.0;       ///< about z, at q_i = 0, rad
  JointType type = JointType::kRevolute;
  double tilt = 0.0;  ///< what the roll has beside its quarter turns, rad, within +-pi/4

  /// Returns the whole roll about x, rad. [any]
  constexpr double roll() const { return roll_quarter_turns * 1.57079632679489661923 + tilt; }
};

/// True if joint i of robot R is prismatic. [any]
template <class R>
constexpr bool is_prismatic(int i) {
  return R::kJoints[static_cast<unsigned>(i)].type == JointType::kPrismatic;
}

/// True if some joint of robot R is prismatic. [any]
template <class R>
constexpr bool has_prismatic() {
  for (const JointFrame& joint : R::kJoints)
    if (joint.type == JointType::kPrismatic) return true;
  return false;
}

/// Mass distribution of a link in the axes of its joint frame, with the tensor about the centre of
/// mass.
struct LinkInertia {
  double mass;                    ///< kg
  double cx, cy, cz;              ///< centre of mass, m
  double xx, xy, xz, yy, yz, zz;  ///< kg m^2
};

/// Bounds of one joint. The torque rate is that of the commanded torque. Of a prismatic joint, read
/// m for rad and N for N m, here and wherever a unit of joints is stated.
struct JointLimit {
  double q_min, q_max;  ///< rad
  double dq_max;        ///< rad/s
  double ddq_max;       ///< rad/s^2
  double dddq_max;      ///< rad/s^3
  double tau_max;       ///< N m
  double dtau_max;      ///< N m/s
};

/// Bounds of the tool tip's reference in the base frame. Each bounds the length of a vector.
struct TaskLimit {
  double v_max;       ///< m/s
  double a_max;       ///< m/s^2
  double j_max;       ///< m/s^3
  double w_max;       ///< rad/s
  double alpha_max;   ///< rad/s^2
  double dalpha_max;  ///< rad/s^3
  double force_max;   ///< N
  double moment_max;  ///< N m
};

/// Gravity that every model uses, m/s^2, along -z of the world.
inline constexpr double kGravity_m_s2 = 9.81;

/// Half the edge of the box around the base in which every tip must be, m: the flange of an arm of
/// 1.3 m reach, whose shoulder is up to 0.4 m above the base, is inside with 0.3 m left for a tool.
/// The box refuses only absurd positions; a pipeline file gives the box of its task.
inline constexpr double kWorkspace_m = 2.0;

}  // namespace tactus
