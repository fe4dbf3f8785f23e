// PointStream: turns online points that arrive as a stream into a target that moves smoothly.
//
// Points arrive about every D seconds, with jitter. Their times are smoothed,
//   t_k = t_(k-1) + D + g (arrival - t_(k-1) - D),   g = 1/k, at least 0.05,
// with g at least 0.2 for a point that is early, as points are delayed but never sent early. D is
// smoothed in the same way.
// The target is the parabola that fits the newest four points best; for a stream that gives
// velocities, the one through the newest point with the change of velocity since the point before.
// In the chart of the newest point, where p_k is the difference from it,
//   p = (19 p0 + 3 p1 - 3 p2 + p3) / 20,   v = (21 p0 - 13 p1 - 17 p2 + 9 p3) / (20 D),
//   a = (p0 - p1 - p2 + p3) / (2 D^2).
// The jump from the old prediction to the new one fades over 3 D by a quintic, so that the target
// is continuous up to its acceleration.
//
// Fewer than four points without velocity are no stream but places to go to, and so are the points
// of a stream that has gone silent. A point after the silence begins a new stream.
#pragma once

#include <array>

#include "kernel/reference/motion/trajectory.hpp"

namespace tactus {

template <class Space>
class PointStream {
 public:
  using Point = typename Space::Point;

  /// Takes a point that arrives at `now_s`; if several arrive at one time, the last counts.
  /// [cyclic]
  void push(const Point& point, double now_s);
  /// Forgets all points. [cyclic]
  void clear() { count_ = 0; }

  /// True if the points are a stream that has not gone silent at `now_s`. [cyclic]
  bool moves(double now_s) const;
  /// True if the points are a stream that has gone silent at `now_s`. [cyclic]
  bool silent(double now_s) const;
  /// Returns the target of a moving stream at `now_s`. [cyclic]
  Point target(double now_s) const;
  bool gives_velocity() const { return given_; }
  /// Seconds between two points; 0 if there are fewer than two.
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
  double arrival_s_ = 0.0;             // arrival of the newest
  double time_s_ = 0.0, period_s_ = 0.0;
  Difference fit_;   // at time_s_, in the chart of the newest point
  Difference jump_;  // at jump_s_, from the prediction to the target
  double jump_s_ = 0.0;
};

}  // namespace tactus
