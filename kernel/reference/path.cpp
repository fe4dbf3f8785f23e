#include "kernel/reference/path.hpp"

#include <algorithm>

#include "kernel/loop_bound.hpp"
#include "kernel/reference/joint_space.hpp"
#include "kernel/reference/task_space.hpp"

namespace tactus {
namespace {

// Times are sums of periods; a billionth of a second is far below any period and far above their
// rounding.
constexpr double kTimeRounding_s = 1e-9;

}  // namespace

template <class Space>
Path<Space>::Path(const Trajectory<Space>& trajectory, const Point& reference)
    : trajectory_(&trajectory),
      latched_(Space::latch(trajectory.terms, reference)),
      use_(Space::placed(trajectory.use, latched_)) {}

template <class Space>
int Path<Space>::waypoint_from(double s) const {
  int before = -1, found = trajectory_->count - 1;  // before < the one looked for <= found
  LoopBound<31> halvings;                           // of an int
  while (found - before > 1) {
    halvings.tick();
    const int middle = before + (found - before) / 2;
    (trajectory_->at(middle).time_s >= s ? found : before) = middle;
  }
  return found;
}

template <class Space>
void Path<Space>::enter(double s) {
  if (trajectory_->count == 1) {
    target_ = 0;
    segment_start_s_ = first_s();
    segment_ = Segment(end(), end(), 1.0, Interpolation::kLinear, 0);
    return;
  }
  target_ = std::max(waypoint_from(s + kTimeRounding_s), 1);
  segment_start_s_ = trajectory_->at(target_ - 1).time_s;
  segment_ = trajectory_->segment(target_, latched_);
}

template <class Space>
Verdict Path<Space>::lead_in(const Point& reference, double s, int target,
                             const Settings& settings) {
  // From rest by the fields the trajectory gives; out of a motion so that nothing steps.
  const Interpolation how =
      reference.standing() ? trajectory_->interpolation : Interpolation::kQuintic;
  target_ = target;
  segment_start_s_ = s;
  segment_ = Segment(reference, trajectory_->point(target, latched_),
                     trajectory_->at(target).time_s - s, how, trajectory_->fields);
  Verdict verdict = Space::judge(segment_, settings.limits, 1.0 - 0.5 * settings.stop_reserve);
  if (verdict.ok()) verdict = judge_corners(reference, settings);
  if (verdict.ok())
    use_ = Space::use(segment_, settings.limits, use_);
  else
    verdict.waypoint = target;
  return verdict;
}

/// The steps in velocity at both ends of the segment that leads in.
template <class Space>
Verdict Path<Space>::judge_corners(const Point& reference, const Settings& settings) const {
  const Verdict verdict = Space::judge_step(reference, segment_.at(0.0), settings.limits);
  if (!verdict.ok()) return verdict;
  const Point arrival = segment_.at(segment_.duration());
  const Point onward = target_ + 1 < trajectory_->count
                           ? trajectory_->segment(target_ + 1, latched_).at(0.0)
                           : arrival.at_rest();
  return Space::judge_step(arrival, onward, settings.limits);
}

template <class Space>
bool Path<Space>::ended(double s) const {
  return !trajectory_->open && s + kTimeRounding_s >= end_s();
}

template <class Space>
typename Space::Point Path<Space>::at(double s) {
  int target = target_;
  for (int i = 0; i < kMaxSegmentsPerCycle && target + 1 < trajectory_->count &&
                  s + kTimeRounding_s >= trajectory_->at(target).time_s;
       ++i) {
    ++target;
  }
  if (target != target_) {
    target_ = target;
    segment_ = trajectory_->segment(target, latched_);
    segment_start_s_ = trajectory_->at(target - 1).time_s;
  }
  return segment_.at(std::min(s - segment_start_s_, segment_.duration()));
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
