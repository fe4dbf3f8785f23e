#include "kernel/reference/admission.hpp"

#include <cmath>

#include "kernel/reference/joint_space.hpp"
#include "kernel/reference/task_space.hpp"

namespace tactus {
namespace {

// Times in a file are rounded to some ten digits; a spacing met exactly must not be refused for it.
constexpr double kRounding_s = 1e-9;

template <class Space>
Verdict admit_times(const Trajectory<Space>& trajectory, double period_s) {
  const double spacing = period_s / kMaxSegmentsPerCycle;
  double earliest = 0.0;
  for (int i = 0; i < trajectory.count; ++i) {
    const double time = trajectory.waypoints[i].time_s;
    if (!std::isfinite(time)) return {Status::kReferenceNotFinite, i, -1, time, 0.0};
    if (time < earliest - kRounding_s) return {Status::kReferenceTime, i, -1, time, earliest};
    earliest = time + spacing;
  }
  return {};
}

Verdict at_waypoint(Verdict verdict, int waypoint) {
  verdict.waypoint = waypoint;
  return verdict;
}

/// One waypoint and the segment that ends there; `before` is where the last one ended, and becomes
/// where this one does.
template <class Space>
Verdict admit_waypoint(Trajectory<Space>& trajectory, int index,
                       const AdmissionSettings<Space>& settings, typename Space::Point& before) {
  const typename Space::Point& point = trajectory.waypoints[index].point;
  Verdict verdict = Space::judge(point, settings.limits);
  if (!verdict.ok() || index == 0) return verdict;
  const typename Space::Segment segment = trajectory.segment(index);
  verdict = Space::judge(segment, settings.limits, 1.0 - settings.stop_reserve);
  if (verdict.ok()) verdict = Space::judge_step(before, segment.at(0.0), settings.limits);
  if (verdict.ok()) trajectory.use = Space::use(segment, settings.limits, trajectory.use);
  before = segment.at(segment.duration());
  return verdict;
}

}  // namespace

template <class Space>
Verdict admit(Trajectory<Space>& trajectory, const AdmissionSettings<Space>& settings) {
  if (trajectory.count < 1 || trajectory.count > trajectory.capacity)
    return {Status::kReferenceSize, -1, -1, static_cast<double>(trajectory.count),
            static_cast<double>(trajectory.capacity)};
  Verdict verdict = admit_times(trajectory, settings.period_s);
  if (!verdict.ok()) return verdict;
  trajectory.use = {};
  // A first waypoint at zero is left from rest; the way to a later one is judged when it begins.
  typename Space::Point before = trajectory.waypoints[0].point.at_rest();
  if (trajectory.count > 1) {
    const typename Space::Segment first = trajectory.segment(1);
    before = trajectory.waypoints[0].time_s > 0.0 ? first.at(0.0) : first.corner();
  }
  for (int i = 0; i < trajectory.count; ++i) {
    verdict = at_waypoint(admit_waypoint(trajectory, i, settings, before), i);
    if (!verdict.ok()) return verdict;
  }
  const int last = trajectory.count - 1;
  const typename Space::Point& end = trajectory.waypoints[last].point;
  verdict = Space::judge_end(end);
  if (verdict.ok() && last > 0) verdict = Space::judge_step(before, end.at_rest(), settings.limits);
  return at_waypoint(verdict, last);
}

template Verdict admit(Trajectory<JointSpace>&, const AdmissionSettings<JointSpace>&);
template Verdict admit(Trajectory<TaskSpace>&, const AdmissionSettings<TaskSpace>&);

}  // namespace tactus
