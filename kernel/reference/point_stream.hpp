// PointStream: online points as people stream them, made a target that moves smoothly.
//
// Points arrive about every D seconds, sooner or later. Their times are smoothed,
//   t_k = t_(k-1) + D + g (arrival - t_(k-1) - D),   D likewise,   g = 1/k, at least 0.05,
// and at least 0.2 for one that is early: what comes is delayed, more or less, and never ahead.
// Through the newest four goes the parabola that fits them best; of a stream that gives velocities,
// through the newest with the change of velocity since the one before. In the chart of the newest
// point, p_k being the difference to it,
//   p = (19 p0 + 3 p1 - 3 p2 + p3) / 20,   v = (21 p0 - 13 p1 - 17 p2 + 9 p3) / (20 D),
//   a = (p0 - p1 - p2 + p3) / (2 D^2).
// The jump from the old prediction to the new one fades over 3 D, by a quintic, so that the target
// is continuous up to its acceleration.
//
// Fewer than four points without velocity are places to go to, no stream, and so is a stream that
// has gone silent; where one is heard again after that, it begins anew.
#pragma once

#include <array>

#include "kernel/reference/trajectory.hpp"

namespace tactus {

template <class Space>
class PointStream {
 public:
  using Point = typename Space::Point;

  /// A point arrives at `now_s`; of several at one time the last counts. [cyclic]
  void push(const Point& point, double now_s);
  /// Nothing was ever said. [cyclic]
  void clear() { count_ = 0; }

  /// Whether the points move at `now_s`: as a stream, not gone silent. [cyclic]
  bool moves(double now_s) const;
  /// It moved, and there has been no point for too long. [cyclic]
  bool silent(double now_s) const;
  /// Where a stream that moves is at `now_s`. [cyclic]
  Point target(double now_s) const;
  bool gives_velocity() const { return given_; }
  /// Seconds between two points; 0: there is only one.
  double period_s() const { return count_ > 1 ? period_s_ : 0.0; }

 private:
  using Difference = typename Space::Difference;
  static constexpr int kFitted = 4;

  bool streams() const { return count_ >= kFitted || (given_ && count_ >= 1); }
  double patience_s() const;
  void keep_time(double now_s);
  Difference fit() const;
  Point predicted(double now_s) const;

  std::array<Point, kFitted> points_;  // newest first
  int count_ = 0;                      // points, at most kMost
  bool given_ = false;                 // velocities are given
  double arrival_s_ = 0.0;             // of the newest
  double time_s_ = 0.0, period_s_ = 0.0;
  Difference fit_;   // at time_s_, in the chart of the newest point
  Difference jump_;  // at jump_s_, from the prediction to the target
  double jump_s_ = 0.0;
};

}  // namespace tactus
