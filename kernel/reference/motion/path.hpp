// Path: a trajectory that is being followed, and its present segment.
#pragma once

#include <algorithm>

#include "kernel/reference/motion/admission.hpp"
#include "kernel/reference/space/peaks.hpp"

namespace tactus {

/// The room at a place of a path (admission_room.hpp), and its derivative with respect to path
/// time, 1/s.
struct Room {
  double most = 1.0, slope = 0.0;
};

/// Returns the lowest room between two places `apart_s` apart, where a falling and a rising line
/// meet; 1 if they do not. Without it the target of the rate would depend on the places sampled.
/// [any]
inline double lowest_between(const Room& from, const Room& to, double apart_s) {
  if (!(from.slope < 0.0 && to.slope > 0.0)) return 1.0;
  const double t = (to.most - from.most - to.slope * apart_s) / (from.slope - to.slope);
  return from.most + from.slope * std::clamp(t, 0.0, apart_s);
}

template <class Space>
class Path {
 public:
  using Point = typename Space::Point;
  using Segment = typename Space::Segment;
  using Settings = AdmissionSettings<Space>;

  /// One segment, its beginning in path time, and the waypoint at which it ends.
  struct Piece {
    int target = -1;
    double start_s = 0.0;
    Segment segment;
  };

  Path() = default;
  /// Resolves the trajectory's header now, while the reference is `reference`; does not enter the
  /// path yet. [cyclic]
  Path(const Trajectory<Space>& trajectory, const Point& reference,
       const typename Space::Limits& limits);

  /// Judges the placement, which was not available at admission. [cyclic]
  Verdict judge_placement(const Settings& settings) const {
    return Space::judge_placed(extent_, placement_, settings.limits);
  }
  /// Enters the path at path time s, which is not before its first waypoint. [cyclic]
  void enter(double s);
  /// Enters by one segment from the reference `sent` at path time s to the first waypoint, which
  /// is ahead; refuses if the segment, measured with `accuracy`, breaks a limit. [cyclic]
  Verdict join_from(const Point& sent, double s, const Settings& settings, Accuracy accuracy);
  /// Ends following the path. [cyclic]
  void leave() { trajectory_ = nullptr; }
  bool running() const { return trajectory_ != nullptr; }

  /// Returns the point at path time s and makes its segment the present one. [cyclic]
  Point at(double s);
  /// Returns the derivatives at path time s, which is not before the present segment: on that one,
  /// the `known` one, or `ahead`, which becomes the segment of s if it is none of them. [cyclic]
  typename Space::Local local(double s, const Piece& known, Piece& ahead) const;
  /// Returns the room at path time s, from which the path can be slowed down in time for all that
  /// follows. [cyclic]
  Room room(double s) const;
  /// True if the path may be passed at the full rate everywhere. [cyclic]
  bool free() const { return !open() && !extent_.slowed; }
  /// True if the path has ended at path time s and will not be extended. [cyclic]
  bool ended(double s) const;
  Point end() const { return trajectory_->point(trajectory_->count - 1, placement_); }
  /// Returns the beginning of the present segment, Segment::corner(). [cyclic]
  Point begin() const { return present_.segment.corner(); }

  /// kLinear, whose velocity steps at waypoints, kCubic, whose acceleration does, or kQuintic.
  Interpolation order() const { return order_of(trajectory_->interpolation, trajectory_->fields); }
  bool smooth() const { return order() == Interpolation::kQuintic; }
  double first_s() const { return trajectory_->time_s(0); }
  double end_s() const { return trajectory_->end_s(); }
  bool open() const { return trajectory_->open; }
  /// Index of the first waypoint that is still needed.
  int needed() const { return present_.target > 0 ? present_.target - 1 : 0; }

  /// Adds the extent of a new part of an open trajectory; refuses if that part, once placed, breaks
  /// a limit. [cyclic]
  Verdict extend(const typename Space::Extent& more, const Settings& settings);

 private:
  Verdict judge_corners(const Point& reference, const Settings& settings) const;
  int waypoint_from(double s, int before) const;
  int target_at(double s) const;
  [[gnu::noinline]] void build(Piece& place, int target) const;  // kilobytes of code, once

  const Trajectory<Space>* trajectory_ = nullptr;
  typename Space::Placement placement_;
  typename Space::Extent extent_;
  Piece present_;
};

}  // namespace tactus
