// Segment: the path of one move from the end of the last one. With s = x / length from 0 to 1
//
//   movej         q = q0 + s (q1 - q0)                 length: of the leading axis, rad
//   movel, movep  p = p0 + s (p1 - p0)                 length: of the line, m
//   movec         p = c + Rot(n, s phi) (p0 - c)       length: of the arc, m
//
// and the tool turns by the fraction s of the angle between its orientations, R = R0 Exp(s log(R0'
// R1)), or with the circle, R = Rot(n, s phi) R0. If the angle in rad is larger than the distance
// in m, it is the length.
#pragma once

#include "sim_plant/ur/motion/curve.hpp"
#include "sim_plant/ur/motion/move.hpp"

namespace tactus::ur {

inline constexpr double kNoLength = 1e-9;  ///< m or rad; a shorter way counts as none

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
