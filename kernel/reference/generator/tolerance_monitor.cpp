#include "kernel/reference/generator/tolerance_monitor.hpp"

#include <new>

#include "kernel/reference/space/joint_space.hpp"
#include "kernel/reference/space/judge_channels.hpp"
#include "kernel/reference/space/task_space.hpp"

namespace tactus {

template <class Space>
void ToleranceMonitor<Space>::start(const Point& reference, int latency_cycles,
                                    bool measures_velocity) {
  new (this) ToleranceMonitor();
  measures_velocity_ = measures_velocity;
  line_.fill(reference);
  latency_ = static_cast<std::size_t>(latency_cycles);
}

template <class Space>
void ToleranceMonitor<Space>::begin(const Tolerances<Space>& tolerances) {
  tolerances_ = tolerances;
  waiting_s_ = inside_s_ = window_s_ = 0.0;
  found_ = {Status::kGoalVelocity};
}

template <class Space>
void ToleranceMonitor<Space>::record(const Point& reference) {
  newest_ = (newest_ + 1) % line_.size();
  line_[newest_] = reference;
}

/// A reference rests in a band, as what a leader sends is never quite the same.
template <class Space>
Verdict ToleranceMonitor<Space>::holds(const Point& measured, double dt_s) {
  if constexpr (Space::kHeldByLaw) {
    typename Space::Band band = tolerances_.path;
    band.q *= kRests;
    const Point& now = line_[newest_];
    if (!Space::judge_error(now, window_from_, band, Status::kPathTolerance).ok()) {
      window_from_ = now;
      waiting_s_ = 0.0;
    }
    waiting_s_ += dt_s;
    const double longest_s = tolerances_.goal_time_s;
    if (longest_s > 0.0 && waiting_s_ > longest_s) return follows(measured);
  }
  return {};
}

/// Returns the reference that the robot should have reached by now.
template <class Space>
const typename Space::Point& ToleranceMonitor<Space>::expected() const {
  return line_[(newest_ + line_.size() - latency_) % line_.size()];
}

template <class Space>
Verdict ToleranceMonitor<Space>::follows(const Point& measured) const {
  return Space::judge_error(expected(), measured, tolerances_.path, Status::kPathTolerance);
}

template <class Space>
typename ToleranceMonitor<Space>::Arrival ToleranceMonitor<Space>::arrived(const Point& measured,
                                                                           double dt_s,
                                                                           Verdict& why) {
  why = Space::judge_error(expected(), measured, tolerances_.goal, Status::kGoalTolerance);
  if (why.ok()) why = stopped(measured, dt_s);
  inside_s_ = why.ok() ? inside_s_ + dt_s : 0.0;
  if (why.ok() && inside_s_ >= tolerances_.dwell_s) return Arrival::kArrived;
  waiting_s_ += dt_s;
  const bool late = tolerances_.goal_time_s > 0.0 && waiting_s_ > tolerances_.goal_time_s;
  return late ? Arrival::kLate : Arrival::kWaiting;
}

template <class Space>
Verdict ToleranceMonitor<Space>::stopped(const Point& measured, double dt_s) {
  const double limit = tolerances_.stopped_velocity;
  if (measures_velocity_ || !(limit > 0.0)) return judge_stopped<Space>(measured, limit);
  Point moved = measured;
  Space::rates(moved) = Space::secant(window_from_, measured, kWindow_s);
  window_s_ += dt_s;
  const Verdict within = judge_stopped<Space>(moved, limit);
  if (window_s_ > kWindow_s || !within.ok()) {
    found_ = within;
    window_from_ = measured;
    window_s_ = 0.0;
  }
  return found_;
}

template class ToleranceMonitor<JointSpace>;
template class ToleranceMonitor<TaskSpace>;

}  // namespace tactus
