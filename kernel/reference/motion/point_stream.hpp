// PointStream: turns online points that arrive as a stream into a target that moves smoothly.
//
// Points arrive about every D seconds, with jitter. Their times are smoothed,
//   t_k = t_(k-1) + d + g (arrival - t_(k-1) - d),   g = 1/k, at least 0.05,
// with g at least 0.2 for a point that is early, as points are delayed but never sent early. D is
// smoothed in the same way. The distance d of two points is D, or that of their stamps, so that
// neither delay nor loss of points with stamps bends the motion.
// The target is the parabola that fits the newest point and three before it best
// (parabola_fit.hpp), in the chart of the newest; one step among them does not make it move. In a
// fast stream only points far enough apart for their noise are kept. For a stream
// that gives velocities it is the parabola through the newest point with the change of velocity
// since the point before; a point without a velocity ends it, as a place to go to. The jump from
// the old prediction to the new one fades over 3 D, at least 0.12 s, by a quintic, so that the
// target is continuous up to its acceleration.
//
// Fewer than four points without velocity are no stream but places to go to, and so are the points
// of a stream that has gone silent. A point after the silence begins a new stream.
#pragma once

#include <array>

#include "kernel/core/streams.hpp"
#include "kernel/reference/motion/parabola_fit.hpp"
#include "kernel/reference/motion/trajectory.hpp"

namespace tactus {

/// Points farther apart are no stream.
inline constexpr double kSlowest_s = 0.25;

template <class Space>
class PointStream {
 public:
  using Point = typename Space::Point;

  /// Takes a point that arrives at `now_s`; of several without stamps that arrive at one time the
  /// last counts. Stamps are finite, in s by any clock that does not step, or kNoStamp; one that is
  /// not 0.1 ms to 0.25 s later than the last begins a new stream.
  /// [cyclic]
  void push(const Point& point, double now_s, double stamp_s);
  /// Forgets all points. [cyclic]
  void clear() { count_ = 0; }

  /// True if a point has arrived at most kSlowest_s before `now_s`. [cyclic]
  bool recent(double now_s) const { return count_ > 0 && now_s - arrival_s_ <= kSlowest_s; }
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
  using Vector = typename Space::Rates;

  bool streams() const { return count_ >= kFitted || (given_ && count_ >= 1); }
  double patience_s() const;
  bool continues(double now_s, double stamp_s) const;
  void keep_time(double now_s, double stamp_s);
  void keep(double distance);
  double unit_s() const { return stamped_ ? 1.0 : period_s_; }
  double apart_s(std::size_t i) const { return unit_s() * static_cast<double>(apart_[i]); }
  Difference fit() const;
  void bound(Difference& fit, const std::array<Vector, kFitted>& places) const;
  Point predicted(double now_s) const;

  std::array<Point, kFitted> points_;  // newest first
  int count_ = 0;                      // points, at most kMost
  bool given_ = false;                 // velocities are given
  bool stamped_ = false;               // stamps are given
  /// Distances of consecutive points: s with stamps, otherwise a count of points, each worth D.
  std::array<float, kFitted - 1> apart_ = {};
  double stamp_s_ = kNoStamp;  // of the newest
  double arrival_s_ = 0.0;     // arrival of the newest
  double time_s_ = 0.0, period_s_ = 0.0;
  Difference fit_;   // at time_s_, in the chart of the newest point
  Difference jump_;  // at jump_s_, from the prediction to the target
  double jump_s_ = 0.0;
};

}  // namespace tactus
