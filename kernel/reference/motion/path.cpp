#include "kernel/reference/motion/path.hpp"

#include <algorithm>
#include <cassert>
#include <new>

#include "kernel/core/loop_bound.hpp"
#include "kernel/reference/motion/time_rounding.hpp"
#include "kernel/reference/space/joint_space.hpp"
#include "kernel/reference/space/limit_check.hpp"
#include "kernel/reference/space/task_space.hpp"

namespace tactus {

template <class Space>
Path<Space>::Path(const Trajectory<Space>& trajectory, const Point& reference,
                  const typename Space::Limits& limits)
    : trajectory_(&trajectory),
      placement_(Space::latch(trajectory.header, reference, limits)),
      extent_(Space::placed(trajectory.extent, placement_)) {}

/// Returns the first waypoint after `before` whose time is s or later, by bisection; the last if
/// there is none.
template <class Space>
int Path<Space>::waypoint_from(double s, int before) const {
  int found = trajectory_->count - 1;  // before < the one looked for <= found
  LoopBound<15> halvings;              // of kMostWaypoints
  while (found - before > 1) {
    halvings.tick();
    const int middle = before + (found - before) / 2;
    (trajectory_->time_s(middle) >= s ? found : before) = middle;
  }
  return found;
}

/// Returns the waypoint at which the segment that contains path time s ends. Most often that is the
/// present segment or the next one.
template <class Space>
int Path<Space>::target_at(double s) const {
  const int last = trajectory_->count - 1, present = present_.target;
  const double later = s + kTimeRounding_s;
  if (present == last || later < trajectory_->time_s(present)) return present;
  if (later < trajectory_->time_s(present + 1)) return present + 1;
  return waypoint_from(later, present);
}

/// Builds a piece where it stays, so that no polynomial is copied.
template <class Space>
void Path<Space>::build(Piece& place, int target) const {
  new (&place)
      Piece{target, trajectory_->time_s(target - 1), trajectory_->segment(target, placement_)};
}

template <class Space>
void Path<Space>::enter(double s) {
  if (trajectory_->count == 1)
    present_ = {0, first_s(), Segment(end(), end(), 1.0, Interpolation::kLinear, 0)};
  else
    build(present_, std::max(waypoint_from(s + kTimeRounding_s, -1), 1));
}

template <class Space>
Verdict Path<Space>::join_from(const Point& sent, double s, const Settings& settings,
                               Accuracy accuracy) {
  assert(accuracy != Accuracy::kFine);
  const Point reference = Space::without_held(sent, placement_);
  // At rest the interpolation of the trajectory is used; in motion a quintic avoids steps.
  const Interpolation how =
      reference.standing() ? trajectory_->interpolation : Interpolation::kQuintic;
  const Point to = trajectory_->point(0, placement_);
  new (&present_) Piece{0, s, Segment(reference, to, first_s() - s, how, trajectory_->fields)};
  const typename Space::Peaks most =
      Space::peaks(settings.limits).reserved(1.0 - 0.5 * settings.stop_reserve);
  const typename Space::Measure measure =
      Space::measure(present_.segment, settings.limits, most, accuracy);
  Verdict verdict = Space::judge_room(measure, settings.limits, reference);
  if (verdict.ok()) verdict = judge(measure.peaks, most, Space::kChannelSize);
  if (verdict.ok() && !smooth()) verdict = judge_corners(reference, settings);
  if (verdict.ok())
    extent_ = Space::Extent::largest(Space::extent_of(measure), extent_);
  else
    verdict.waypoint = 0;
  return verdict;
}

/// Judges the steps in velocity at both ends of the segment that leads in.
template <class Space>
Verdict Path<Space>::judge_corners(const Point& reference, const Settings& settings) const {
  const Segment& segment = present_.segment;
  typename Space::Levels level{};
  const Verdict verdict =
      Space::judge_step(reference, segment.at(0.0), settings.limits, 0.0, level);
  if (!verdict.ok()) return verdict;
  const Point arrival = segment.at(segment.duration());
  const Point onward =
      trajectory_->count > 1 ? trajectory_->segment(1, placement_).at(0.0) : arrival.at_rest();
  return Space::judge_step(arrival, onward, settings.limits, segment.duration(), level);
}

template <class Space>
bool Path<Space>::ended(double s) const {
  return !trajectory_->open && s + kTimeRounding_s >= end_s();
}

template <class Space>
typename Space::Point Path<Space>::at(double s) {
  const int target = target_at(s);
  if (target != present_.target) build(present_, target);
  return present_.segment.at(std::min(s - present_.start_s, present_.segment.duration()));
}

template <class Space>
typename Space::Local Path<Space>::local(double s, const Piece& known, Piece& ahead) const {
  const int target = target_at(s);
  const Piece& on = target == present_.target ? present_ : target == known.target ? known : ahead;
  if (target != on.target) build(ahead, target);
  return on.segment.local(std::clamp(s - on.start_s, 0.0, on.segment.duration()));
}

template <class Space>
Room Path<Space>::room(double s) const {
  if (free()) return {};
  const int target = target_at(s);
  const WaypointRooms& to = trajectory_->rooms(target);
  // The segment that leads in is judged at the full rate; the room at its end is enough.
  if (target == 0) return {to.room, 0.0};
  const WaypointRooms& from = trajectory_->rooms(target - 1);
  const double from_s = trajectory_->time_s(target - 1);
  const double T = 0.5 * (trajectory_->time_s(target) - from_s), t = std::max(0.0, s - from_s);
  const bool second = t > T;
  const double begin = static_cast<float>(second ? to.halfway : from.room);
  const double end = static_cast<float>(second ? to.room : to.halfway);
  const double slope = (end - begin) / T;
  return {begin + slope * std::min(second ? t - T : t, T), slope};
}

template <class Space>
Verdict Path<Space>::extend(const typename Space::Extent& more, const Settings& settings) {
  const typename Space::Extent placed = Space::placed(more, placement_);
  const Verdict verdict = Space::judge_placed(placed, placement_, settings.limits);
  if (verdict.ok()) extent_ = Space::Extent::largest(extent_, placed);
  return verdict;
}

template class Path<JointSpace>;
template class Path<TaskSpace>;

}  // namespace tactus
