// The path of one move, and how fast the joints can follow it.
#pragma once

#include <algorithm>

#include "sim_plant/ur/motion/kinematics.hpp"

namespace tactus::ur {

/// The limits of the set-point generator, and those of the path check, which are not published;
/// rad, rad/s and rad/s^2.
struct MotionLimits {
  Joints speed;                    ///< highest speed of the joints
  double acceleration = 40.0;      ///< of a joint in moves: not published
  double position = 6.3355;        ///< 363 degrees: the default safety limit
  double sudden_change = 0.5;      ///< distance of a servo set-point from the present target
  double sudden_stop = 0.1;        ///< target speed from which a standstill is too sudden
  double stop_acceleration = 4.0;  ///< of a program that ends
  double protective_acceleration = 12.0;

  MotionLimits() {
    speed << 120.0, 120.0, 180.0, 180.0, 180.0, 180.0;
    speed *= kDegree;
  }
};

/// Limits a speed, acceleration or time of a script to a range that arithmetic can handle; returns
/// the default for a value that is not positive or NaN.
inline double given_or(double value, double otherwise) {
  return value > 0.0 ? std::clamp(value, 1e-9, 1e9) : otherwise;
}

/// Curve: a path of the arm over a coordinate x from 0 to length(), and how fast it can be
/// followed: at samples of the curve with dq/dx = q' and d(q')/dx = q'', no joint exceeds its
/// limits if
///
///   dx/dt <= speed / |q'|,   dx/dt <= sqrt(ddq / |q''|),   d2x/dt2 <= ddq / |q'|
///
/// where the last two share the acceleration.
class Curve {
 public:
  virtual double length() const = 0;
  /// Returns the posture at `x` nearest to `near`, rad, and dq/dx. False: there is none.
  virtual bool at(double x, const Joints& near, Joints& q, Joints& slope) const = 0;

 protected:
  ~Curve() = default;
};

/// Speed and acceleration, in units of x per s and s^2.
struct Rates {
  double v = 0.0, a = 0.0;
};

/// Returns the highest rates that the joints allow, with `share` of their acceleration for bends.
/// `q` is the posture at the beginning and becomes that at the end. False: the arm cannot follow.
/// [any]
bool fastest(const Curve& curve, double share, const MotionLimits& limits, Joints& q, Rates& rates);

/// Move: the parameters of a move command of a script.
struct Move {
  enum class Kind : std::uint8_t {
    kJ,  ///< movej: the joints keep their proportions
    kL,  ///< movel: a line of the tool
    kP,  ///< movep: a line, with blends in which the tool keeps its speed
    kC,  ///< movec: a circle
  };
  Kind kind = Kind::kJ;
  Joints q = Joints::Zero();  ///< of movej
  Frame via, target;          ///< of the others; only the position of `via` counts
  bool fixed = false;         ///< movec: the tool keeps its orientation relative to the circle
  /// Not positive: the default of the script manual. `t`, from rest to rest, has precedence.
  double a = 0.0, v = 0.0, t = 0.0;
  double r = 0.0;  ///< blend radius, m
};

inline constexpr double kNoLength = 1e-9;  ///< m or rad; a shorter way counts as none

/// Segment: the path of one move from the end of the last one. With s = x / length from 0 to 1
///
///   movej         q = q0 + s (q1 - q0)                 length: of the leading axis, rad
///   movel, movep  p = p0 + s (p1 - p0)                 length: of the line, m
///   movec         p = c + Rot(n, s phi) (p0 - c)       length: of the arc, m
///
/// and the tool turns by the fraction s of the angle between its orientations, R = R0 Exp(s log(R0'
/// R1)), or with the circle, R = Rot(n, s phi) R0. If the angle in rad is larger than the distance
/// in m, it is the length.
class Segment final : public Curve {
 public:
  /// `tool` is the tip in the flange. False: the arm cannot follow, or the target is too far. [any]
  bool start(const Move& move, const Joints& from, const Frame& tool, const MotionLimits& limits);

  double length() const override { return length_; }
  bool at(double x, const Joints& near, Joints& q, Joints& slope) const override;
  /// The tip at x, and its derivative [v; w] with respect to x.
  Frame tip(double x) const;
  Vector6 twist(double x) const;
  /// Finds the distance in x from the beginning, or from the end, beyond which the tip is more than
  /// `r` away from it. False: the tip never gets so far.
  bool way_within(double r, bool from_end, double& x) const;

  const Move& move() const { return move_; }
  void leave_out_blend() { move_.r = 0.0; }
  const Frame& tool() const { return tool_; }
  bool in_joints() const { return move_.kind == Move::Kind::kJ; }
  const Joints& begin() const { return from_; }
  const Joints& end() const { return to_; }
  /// The rates of the command, limited to those of the joints.
  const Rates& pace() const { return pace_; }
  /// The highest rates that the joints allow.
  const Rates& most() const { return most_; }

 private:
  void measure_tool();
  bool fit_circle();
  void choose_pace();
  double share(double x) const { return length_ > 0.0 ? x / length_ : 1.0; }

  Move move_;
  Frame tool_, tip_from_;
  Joints from_ = Joints::Zero(), to_ = Joints::Zero();
  double length_ = 0.0;
  Rates pace_, most_;
  Vector3 way_ = Vector3::Zero();   // translation of a line
  Vector3 turn_ = Vector3::Zero();  // rotation vector between the orientations, in the first
  bool arc_ = false;
  Vector3 center_ = Vector3::Zero(), axis_ = Vector3::Zero();
  double angle_ = 0.0;
};

}  // namespace tactus::ur
