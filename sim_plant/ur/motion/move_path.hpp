// The path of moves one after the other: the time law of a move, the blend past a waypoint, and the
// run of both.
#pragma once

#include <array>

#include "sim_plant/ur/motion/segment.hpp"

namespace tactus::ur {

/// The time law of a move: a trapezoid of speed over a distance d,
///
///   v0 -> top -> v1,  top = min(v, sqrt(a d + (v0^2 + v1^2) / 2))
///
/// from one speed to another, both zero for a move from rest to rest. If v0 is above v, the move
/// slows down to v first.
class Trapezoid {
 public:
  /// Returns the law over `d` >= 0 from `v0` to `v1` with top speed `v` and acceleration `a` > 0.
  /// If `a` is too small to get from `v0` to `v1`, the law uses the acceleration needed. [any]
  static Trapezoid over(double d, double v0, double v1, double v, double a);

  double duration_s() const { return first_s_ + flat_s_ + last_s_; }
  double top() const { return top_; }
  double position(double t_s) const;  ///< 0 before the beginning, d after the end
  double speed(double t_s) const;     ///< its derivative
  /// Returns when `x` is reached, at the latest when braking begins, s.
  double time_at(double x) const;

 private:
  double v0_ = 0.0, top_ = 0.0, v1_ = 0.0, way_ = 0.0;
  double first_s_ = 0.0, flat_s_ = 0.0, last_s_ = 0.0;
  double a0_ = 0.0, a1_ = 0.0;  // of the first part, and of the last, which brakes
};

/// Blend: the path past a waypoint P from a segment A to the next, B, over u from 0 to 1. The
/// distance left on A shrinks while the distance gone on B grows,
///
///   left(u) = dA (1 - u)^2 (1 + k u),   gone(u) = dB u^2 (1 + k (1 - u)),
///
/// and both run at the same time: q = A + B - P in the joints if one of the segments is in the
/// joints, otherwise p = A + B - P and R = RA RP' RB for the tool. With k = 0 two lines make a
/// parabola of constant acceleration. Position and velocity are continuous at both ends, and the
/// path stays between the corner and the two lines, within the radius of P.
///
/// Between two lines of movep the tool follows the circle that touches both at the distance e from
/// P, rho = e / tan(theta / 2), at constant speed; k = 2 - theta rho / e makes the turn of the tool
/// continuous too.
class Blend final : public Curve {
 public:
  /// Blends from `left` before the end of `a` to `gone` on `b`, by their x. Both must outlive the
  /// blend. [any]
  void start(const Segment& a, double left, const Segment& b, double gone);

  double length() const override { return 1.0; }
  bool at(double u, const Joints& near, Joints& q, Joints& slope) const override;

  /// dx/du of the segments at entry and exit.
  double entry() const { return (2.0 - k_) * left_; }
  double exit() const { return (2.0 - k_) * gone_; }
  double left() const { return left_; }
  double gone() const { return gone_; }
  /// Returns the largest du/dt for which the acceleration stays below `a_first`; if one of the
  /// moves is in the joints, for which each move stays below its own acceleration.
  double rate(double a_first, double a_next) const;
  bool keeps_speed() const { return circle_; }

 private:
  /// x and dx/du of A and B at u.
  struct Share {
    double x_a, dx_a, x_b, dx_b;
  };
  Share share(double u) const;
  void fit_circle();
  bool at_joints(double u, Joints& q, Joints& slope) const;
  Frame tip(double u, Vector6& twist) const;

  const Segment* a_ = nullptr;
  const Segment* b_ = nullptr;
  double left_ = 0.0, gone_ = 0.0, k_ = 0.0;
  bool circle_ = false;
  Vector3 touch_ = Vector3::Zero(), along_ = Vector3::Zero(), across_ = Vector3::Zero();
  double theta_ = 0.0, rho_ = 0.0;
};

/// MovePath: runs one move after the other, each from rest to rest, or past a waypoint by a blend.
///
/// A move with a blend radius r asks for the next one while it can still slow down for any corner:
/// when the distance to the entry of the blend is (top^2 - a e) / (2 a), with the distance e within
/// the radius. If the next move comes before the entry, the arm leaves the line at r before the
/// waypoint and joins the next line at r after it. If not, or if the radii of two waypoints
/// overlap, it comes to rest at the waypoint.
///
/// In a blend du/dt is constant and limited by both moves' speeds, the acceleration of the first,
/// the joints, and the stop at the end of the second.
class MovePath {
 public:
  enum class Next : std::uint8_t { kBlended, kStops, kUnreachable };

  explicit MovePath(const MotionLimits& limits) : limits_(limits) {}

  /// Begins a move from rest. False: the arm cannot reach the target. [any]
  bool begin(const Move& move, const Joints& from, const Frame& tool);
  /// Adds the move after one that asks(). kStops: the arm comes to rest first. [any]
  Next follow(const Move& move, const Frame& tool);

  /// Moves for at most `h_s`, until the next move is needed or the arm has settled. Returns the
  /// time that it moved. [cyclic]
  double advance(double h_s);
  /// Returns the present posture nearest to `near`, and the joint speeds. False: there is none.
  bool posture(const Joints& near, Joints& q, Joints& dq) const;

  bool asks() const { return asked_; }
  bool done() const { return done_; }
  /// Returns true if overlapping radii were left out since the last call.
  bool take_overlap();

 private:
  enum class Stage : std::uint8_t { kToPoint, kToBlend, kBlend };

  Segment& now() { return segments_[static_cast<std::size_t>(now_)]; }
  const Segment& now() const { return segments_[static_cast<std::size_t>(now_)]; }
  Segment& next() { return segments_[static_cast<std::size_t>(1 - now_)]; }

  void go_to_point(double x, double v);
  bool fit_blend(const Frame& tool);
  Next blend_into(double x_in);
  bool choose_rate(double way, double v);
  void next_stage();

  const MotionLimits& limits_;
  std::array<Segment, 2> segments_;
  int now_ = 0;
  Blend blend_;
  double rate_ = 0.0;  // du/dt
  Stage stage_ = Stage::kToPoint;
  Trapezoid law_;
  double x0_ = 0.0, time_s_ = 0.0, ask_s_ = 0.0;
  bool asked_ = false, done_ = true, overlap_ = false;
};

}  // namespace tactus::ur
