// Path: a trajectory that is being followed, and the place reached on it.
#pragma once

#include "kernel/reference/admission.hpp"

namespace tactus {

/// Largest square of the rate at a place of a path, and how it changes with path time there, 1/s.
struct Room {
  double most = 1.0, slope = 0.0;
};

template <class Space>
class Path {
 public:
  using Point = typename Space::Point;
  using Segment = typename Space::Segment;
  using Settings = AdmissionSettings<Space>;

  /// One segment: where it begins, and the waypoint at which it ends.
  struct Piece {
    int target = -1;
    double start_s = 0.0;
    Segment segment;
  };

  Path() = default;
  /// The trajectory in its terms as of now, with `reference` put out; not entered yet. [cyclic]
  Path(const Trajectory<Space>& trajectory, const Point& reference,
       const typename Space::Limits& limits);

  /// Judges what admission could not know: where the terms have put it. [cyclic]
  Verdict judge_terms(const Settings& settings) const {
    return Space::judge_placed(use_, latched_, settings.limits);
  }
  /// Enters the path where it is at path time s, which is not before its first waypoint. [cyclic]
  void enter(double s);
  /// Enters by one segment from what is `put_out` at path time s to the waypoint `target` ahead;
  /// refused, with that waypoint named, if the segment breaks a limit. [cyclic]
  Verdict lead_in(const Point& put_out, double s, int target, const Settings& settings);
  /// The path is followed no more. [cyclic]
  void leave() { trajectory_ = nullptr; }
  bool running() const { return trajectory_ != nullptr; }

  /// The path at time s, to which the present segment is moved on. [cyclic]
  Point at(double s);
  /// Its derivatives at a time s that the present segment has not passed. `ahead` keeps the segment
  /// that had to be built for it, for the next call. [cyclic]
  typename Space::Local local(double s, Piece& ahead) const;
  /// How fast it may be passed at a time s that the present segment has not passed, so that it can
  /// be slowed down in time for all that follows. [cyclic]
  Room room(double s) const;
  /// There is room for the full rate everywhere. [cyclic]
  bool free() const { return !open() && !use_.slowed; }
  /// Nothing of it is left at path time s, and nothing more will come. [cyclic]
  bool ended(double s) const;
  Point end() const { return trajectory_->point(trajectory_->count - 1, latched_); }
  /// Where the present segment begins, without what steps there by nature. [cyclic]
  Point begin() const { return present_.segment.corner(); }

  /// Its waypoints give accelerations: none steps by nature.
  bool smooth() const {
    return order_of(trajectory_->interpolation, trajectory_->fields) == Interpolation::kQuintic;
  }
  double first_s() const { return trajectory_->at(0).time_s; }
  double end_s() const { return trajectory_->end_s(); }
  bool open() const { return trajectory_->open; }
  /// First waypoint at path time s or later; the last if there is none. A bisection. [cyclic]
  int waypoint_from(double s) const { return waypoint_from(s, -1); }
  /// First waypoint it still needs.
  int needed() const { return present_.target > 0 ? present_.target - 1 : 0; }

  const typename Space::Use& use() const { return use_; }
  /// More of an open trajectory has come; refused if its terms put that out of limits. [cyclic]
  Verdict extend(const typename Space::Use& more, const Settings& settings);

 private:
  Verdict judge_corners(const Point& reference, const Settings& settings) const;
  int waypoint_from(double s, int before) const;
  int target_at(double s) const;
  Piece piece(int target) const;

  const Trajectory<Space>* trajectory_ = nullptr;
  typename Space::Latched latched_;
  typename Space::Use use_;
  Piece present_;
};

}  // namespace tactus
