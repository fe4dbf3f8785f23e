#include "kernel/reference/motion.hpp"

#include <algorithm>

#include "kernel/reference/joint_space.hpp"
#include "kernel/reference/task_space.hpp"

namespace tactus {
namespace {

// Times are sums of periods; a billionth of a second is far below any period and far above their
// rounding.
constexpr double kTimeRounding_s = 1e-9;
// A bridge always gets at least this share of the limits, even beside a path that leaves nothing.
constexpr double kLeastShare = 0.02;

}  // namespace

template <class Space>
void Motion<Space>::start(const Point& point, const Settings& settings) {
  *this = Motion();
  settings_ = &settings;
  reference_ = held_ = point.at_rest();
}

template <class Space>
void Motion<Space>::move_on(double dt_s) {
  watch_end(dt_s);
  law_.advance(dt_s);
  bridge_time_s_ += dt_s;
  reference_ = base();
  bridging_ = bridging_ && bridge_time_s_ < bridge_.duration();
  if (bridging_) reference_ = Space::sum(reference_, bridge_.at(bridge_time_s_));
}

/// A path that is not yet whole is never run to where it ends so far: the arm stops before, and
/// goes on when there is room for twice the way that a stop takes.
template <class Space>
void Motion<Space>::watch_end(double dt_s) {
  if (!on_path() || braking_) return;
  const RateBounds bounds = rate_bounds();
  const double left_s = path_.trajectory->end_s() - law_.s();
  const bool open = path_.trajectory->open;
  if (!starving_ && open && left_s <= law_.stopping_s(bounds) + 2.0 * law_.rate() * dt_s) {
    starving_ = true;
    law_.plan(0.0, bounds);
    return;
  }
  TimeLaw again;
  again.start(rate_);
  if (starving_ && (!open || left_s > 2.0 * again.stopping_s(bounds) + 4.0 * dt_s)) {
    starving_ = false;
    law_.plan(rate_, bounds);
  }
}

/// The path at its present time, or the point that is held. Leaves a path that has come to its end
/// or to rest.
template <class Space>
typename Space::Point Motion<Space>::base() {
  if (!on_path()) return held_;
  const Trajectory<Space>& trajectory = *path_.trajectory;
  const double due_s = law_.s() + kTimeRounding_s;
  const bool ended = !trajectory.open && due_s >= trajectory.end_s();
  int target = path_.target;
  for (int i = 0; i < kMaxSegmentsPerCycle && target + 1 < trajectory.count &&
                  due_s >= trajectory.at(target).time_s;
       ++i) {
    ++target;
  }
  if (target != path_.target) {
    path_.target = target;
    path_.segment = trajectory.segment(target);
    path_.segment_start_s = trajectory.at(target - 1).time_s;
  }
  const double t = std::min(law_.s() - path_.segment_start_s, path_.segment.duration());
  const Point point = path_.segment.at(t).at_rate(law_.rate(), law_.slope());
  if (!ended && !(braking_ && law_.standing())) return point;
  held_ = ended ? trajectory.at(trajectory.count - 1).point.at_rest() : point.at_rest();
  leave_path();
  // The position is held from now on; what the path fed forward is taken to zero.
  if (!bridging_) bridge_from(Space::difference(point.stopped(), point.at_rest()), 1.0);
  return held_;
}

template <class Space>
void Motion<Space>::leave_path() {
  path_.trajectory = nullptr;
  braking_ = starving_ = false;
  law_.start(0.0);
}

template <class Space>
void Motion<Space>::forward(const Point& point) {
  leave_path();
  bridging_ = false;
  reference_ = held_ = point;
}

template <class Space>
void Motion<Space>::shape(const Point& point) {
  leave_path();
  held_ = point.at_rest();
  bridge_from(Space::difference(reference_, held_), 1.0);
}

/// Takes `difference` to zero with half of `share` of the limits.
template <class Space>
void Motion<Space>::bridge_from(const typename Space::Difference& difference, double share) {
  const typename Space::Limits limits = settings_->limits.scaled(share);
  bridge_ = typename Space::Bridge(difference, Space::bridge_time_s(difference, limits));
  bridge_time_s_ = 0.0;
  bridging_ = true;
}

template <class Space>
Verdict Motion<Space>::follow(const Trajectory<Space>& trajectory,
                              const typename Space::Tolerance& tolerance) {
  const Settings& settings = *settings_;
  const Waypoint<Space>& first = trajectory.at(0);
  Path path;
  path.trajectory = &trajectory;
  path.use = trajectory.use;
  Verdict verdict;
  if (first.time_s > 0.0) {
    // From rest by the fields the trajectory gives; out of a motion so that nothing steps.
    const Interpolation how =
        reference_.standing() ? trajectory.interpolation : Interpolation::kQuintic;
    path.segment = Segment(reference_, first.point, first.time_s, how, trajectory.fields);
    verdict = Space::judge(path.segment, settings.limits, 1.0 - 0.5 * settings.stop_reserve);
    if (verdict.ok()) verdict = judge_corners(path.segment, trajectory);
    path.use = Space::use(path.segment, settings.limits, path.use);
  } else {
    path.target = trajectory.count > 1 ? 1 : 0;
    path.segment = trajectory.count > 1
                       ? trajectory.segment(1)
                       : Segment(first.point, first.point, 1.0, Interpolation::kLinear, 0);
    verdict = Space::judge_near(first.point, reference_, tolerance);
  }
  if (!verdict.ok()) {
    verdict.waypoint = 0;
    return verdict;
  }
  const double left = 1.0 - std::max({path.use.velocity, path.use.acceleration, path.use.jerk});
  // Out of a motion the first segment is met at full rate; from rest any rate meets it. Where a
  // path begins with a step by nature, that is its own; the bridge ends the old motion only.
  const double rate = reference_.standing() ? rate_ : 1.0;
  const Point begin = path.segment.corner().at_rate(rate, 0.0);
  bridge_from(Space::difference(reference_, begin), std::max(left, kLeastShare));
  path_ = path;
  braking_ = starving_ = false;
  law_.start(rate);
  return {};
}

/// The steps in velocity at both ends of the way to the first waypoint.
template <class Space>
Verdict Motion<Space>::judge_corners(const Segment& way,
                                     const Trajectory<Space>& trajectory) const {
  const typename Space::Limits& limits = settings_->limits;
  const Verdict verdict = Space::judge_step(reference_, way.at(0.0), limits);
  if (!verdict.ok()) return verdict;
  const Point arrival = way.at(way.duration());
  const Point onward = trajectory.count > 1 ? trajectory.segment(1).at(0.0) : arrival.at_rest();
  return Space::judge_step(arrival, onward, limits);
}

template <class Space>
void Motion<Space>::set_rate(double rate) {
  rate_ = rate;
  if (on_path() && !braking_ && !starving_) law_.plan(rate, rate_bounds());
}

template <class Space>
void Motion<Space>::brake() {
  if (!on_path()) return;
  law_.plan(0.0, rate_bounds());
  braking_ = true;
}

template <class Space>
void Motion<Space>::extend() {
  if (on_path()) path_.use = PathUse::largest(path_.use, path_.trajectory->use);
}

template class Motion<JointSpace>;
template class Motion<TaskSpace>;

}  // namespace tactus
