// MovePath: runs one move after the other, each from rest to rest, or past a waypoint by a blend.
//
// A move with a blend radius r asks for the next one while it can still slow down for any corner:
// when the distance to the entry of the blend is (top^2 - a e) / (2 a), with the distance e within
// the radius. If the next move comes before the entry, the arm leaves the line at r before the
// waypoint and joins the next line at r after it. If not, or if the radii of two waypoints overlap,
// it comes to rest at the waypoint.
//
// In a blend du/dt is constant and limited by both moves' speeds, the acceleration of the first,
// the joints, and the stop at the end of the second.
#pragma once

#include <array>

#include "sim_plant/ur/motion/blend.hpp"
#include "sim_plant/ur/motion/trapezoid.hpp"

namespace tactus::ur {

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
