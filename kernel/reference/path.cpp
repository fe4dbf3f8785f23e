#include "kernel/reference/path.hpp"

#include <algorithm>

#include "kernel/loop_bound.hpp"
#include "kernel/reference/joint_space.hpp"
#include "kernel/reference/limit_check.hpp"
#include "kernel/reference/task_space.hpp"

namespace tactus {
namespace {

// Times are sums of periods; a billionth of a second is far below any period and far above their
// rounding.
constexpr double kTimeRounding_s = 1e-9;

}  // namespace

template <class Space>
Path<Space>::Path(const Trajectory<Space>& trajectory, const Point& reference,
                  const typename Space::Limits& limits)
    : trajectory_(&trajectory),
      latched_(Space::latch(trajectory.terms, reference, limits)),
      use_(Space::placed(trajectory.use, latched_)) {}

/// Of the waypoints behind `before`.
template <class Space>
int Path<Space>::waypoint_from(double s, int before) const {
  int found = trajectory_->count - 1;  // before < the one looked for <= found
  LoopBound<31> halvings;              // of an int
  while (found - before > 1) {
    halvings.tick();
    const int middle = before + (found - before) / 2;
    (trajectory_->at(middle).time_s >= s ? found : before) = middle;
  }
  return found;
}

/// The waypoint at which the segment ends that path time s lies on. Most often it is the present
/// one or the next.
template <class Space>
int Path<Space>::target_at(double s) const {
  const int last = trajectory_->count - 1, present = present_.target;
  const double later = s + kTimeRounding_s;
  if (present == last || later < trajectory_->at(present).time_s) return present;
  if (later < trajectory_->at(present + 1).time_s) return present + 1;
  return waypoint_from(later, present);
}

template <class Space>
typename Path<Space>::Piece Path<Space>::piece(int target) const {
  return {target, trajectory_->at(target - 1).time_s, trajectory_->segment(target, latched_)};
}

template <class Space>
void Path<Space>::enter(double s) {
  if (trajectory_->count == 1)
    present_ = {0, first_s(), Segment(end(), end(), 1.0, Interpolation::kLinear, 0)};
  else
    present_ = piece(std::max(waypoint_from(s + kTimeRounding_s), 1));
}

template <class Space>
Verdict Path<Space>::lead_in(const Point& put_out, double s, int target, const Settings& settings) {
  const Point reference = Space::without_held(put_out, latched_);
  // From rest by the fields the trajectory gives; out of a motion so that nothing steps.
  const Interpolation how =
      reference.standing() ? trajectory_->interpolation : Interpolation::kQuintic;
  const double T = trajectory_->at(target).time_s - s;
  const Point to = trajectory_->point(target, latched_);
  present_ = {target, s, Segment(reference, to, T, how, trajectory_->fields)};
  const typename Space::Peaks most =
      Space::peaks(settings.limits).reserved(1.0 - 0.5 * settings.stop_reserve);
  const typename Space::Measure measure = Space::measure(present_.segment, settings.limits, most);
  Verdict verdict = Space::judge_room(measure, settings.limits);
  if (verdict.ok()) verdict = judge(measure.peaks, most, Space::kChannelSize);
  if (verdict.ok()) verdict = judge_corners(reference, settings);
  if (verdict.ok())
    use_ = Space::Use::largest(Space::use(measure, Space::peaks(settings.limits)), use_);
  else
    verdict.waypoint = target;
  return verdict;
}

/// The steps in velocity at both ends of the segment that leads in.
template <class Space>
Verdict Path<Space>::judge_corners(const Point& reference, const Settings& settings) const {
  const Segment& segment = present_.segment;
  const int next = present_.target + 1;
  typename Space::Levels level{};
  const Verdict verdict =
      Space::judge_step(reference, segment.at(0.0), settings.limits, 0.0, level);
  if (!verdict.ok()) return verdict;
  const Point arrival = segment.at(segment.duration());
  const Point onward =
      next < trajectory_->count ? trajectory_->segment(next, latched_).at(0.0) : arrival.at_rest();
  return Space::judge_step(arrival, onward, settings.limits, segment.duration(), level);
}

template <class Space>
bool Path<Space>::ended(double s) const {
  return !trajectory_->open && s + kTimeRounding_s >= end_s();
}

template <class Space>
typename Space::Point Path<Space>::at(double s) {
  const int target = target_at(s);
  if (target != present_.target) present_ = piece(target);
  return present_.segment.at(std::min(s - present_.start_s, present_.segment.duration()));
}

template <class Space>
typename Space::Local Path<Space>::local(double s, Piece& ahead) const {
  const int target = target_at(s);
  const bool built = target == present_.target || target == ahead.target;
  if (!built) ahead = piece(target);
  const Piece& on = target == present_.target ? present_ : ahead;
  return on.segment.local(std::clamp(s - on.start_s, 0.0, on.segment.duration()));
}

template <class Space>
Room Path<Space>::room(double s) const {
  if (free()) return {};
  const int target = target_at(s);
  const Waypoint<Space>& to = trajectory_->at(target);
  // On the way in, which is admitted at the full rate, what holds at its end will do.
  if (target == 0 ||
      (target == present_.target && present_.start_s != trajectory_->at(target - 1).time_s))
    return {to.room, 0.0};
  const Waypoint<Space>& from = trajectory_->at(target - 1);
  const double T = 0.5 * (to.time_s - from.time_s), t = std::max(0.0, s - from.time_s);
  const bool second = t > T;
  const double begin = static_cast<float>(second ? to.halfway : from.room);
  const double end = static_cast<float>(second ? to.room : to.halfway);
  const double slope = (end - begin) / T;
  return {begin + slope * std::min(second ? t - T : t, T), slope};
}

template <class Space>
Verdict Path<Space>::extend(const typename Space::Use& more, const Settings& settings) {
  const typename Space::Use placed = Space::placed(more, latched_);
  const Verdict verdict = Space::judge_placed(placed, latched_, settings.limits);
  if (verdict.ok()) use_ = Space::Use::largest(use_, placed);
  return verdict;
}

template class Path<JointSpace>;
template class Path<TaskSpace>;

}  // namespace tactus
