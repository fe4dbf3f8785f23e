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
    const double time = trajectory.at(i).time_s;
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

}  // namespace

template <class Space>
Verdict admit_waypoint(const Trajectory<Space>& trajectory, int index,
                       const AdmissionSettings<Space>& settings, typename Space::Point& before,
                       PathUse& use) {
  Verdict verdict = Space::judge(trajectory.at(index).point, settings.limits);
  if (verdict.ok() && index > 0) {
    const typename Space::Segment segment = trajectory.segment(index);
    verdict = Space::judge(segment, settings.limits, 1.0 - settings.stop_reserve);
    if (verdict.ok()) verdict = Space::judge_step(before, segment.at(0.0), settings.limits);
    if (verdict.ok()) use = Space::use(segment, settings.limits, use);
    if (verdict.ok()) before = segment.at(segment.duration());
  }
  return at_waypoint(verdict, index);
}

template <class Space>
Verdict admit_end(const Trajectory<Space>& trajectory, int last,
                  const AdmissionSettings<Space>& settings, const typename Space::Point& before) {
  const typename Space::Point& end = trajectory.at(last).point;
  Verdict verdict = Space::judge_end(end);
  if (verdict.ok() && last > 0) verdict = Space::judge_step(before, end.at_rest(), settings.limits);
  return at_waypoint(verdict, last);
}

template <class Space>
typename Space::Point before_first(const Trajectory<Space>& trajectory) {
  // A first waypoint at zero is left from rest; the way to a later one is judged when it begins.
  if (trajectory.count < 2) return trajectory.at(0).point.at_rest();
  const typename Space::Segment first = trajectory.segment(1);
  return trajectory.at(0).time_s > 0.0 ? first.at(0.0) : first.corner();
}

template <class Space>
Verdict admit(Trajectory<Space>& trajectory, const AdmissionSettings<Space>& settings) {
  if (trajectory.count < 1 || trajectory.count > trajectory.capacity)
    return {Status::kReferenceSize, -1, -1, static_cast<double>(trajectory.count),
            static_cast<double>(trajectory.capacity)};
  Verdict verdict = admit_times(trajectory, settings.period_s);
  if (!verdict.ok()) return verdict;
  trajectory.use = {};
  typename Space::Point before = before_first(trajectory);
  for (int i = 0; i < trajectory.count; ++i) {
    verdict = admit_waypoint(trajectory, i, settings, before, trajectory.use);
    if (!verdict.ok()) return verdict;
  }
  if (trajectory.open) return {};
  return admit_end(trajectory, trajectory.count - 1, settings, before);
}

template Verdict admit(Trajectory<JointSpace>&, const AdmissionSettings<JointSpace>&);
template Verdict admit_waypoint(const Trajectory<JointSpace>&, int,
                                const AdmissionSettings<JointSpace>&, JointSpace::Point&, PathUse&);
template Verdict admit_end(const Trajectory<JointSpace>&, int, const AdmissionSettings<JointSpace>&,
                           const JointSpace::Point&);
template Verdict admit(Trajectory<TaskSpace>&, const AdmissionSettings<TaskSpace>&);
template Verdict admit_waypoint(const Trajectory<TaskSpace>&, int,
                                const AdmissionSettings<TaskSpace>&, TaskSpace::Point&, PathUse&);
template Verdict admit_end(const Trajectory<TaskSpace>&, int, const AdmissionSettings<TaskSpace>&,
                           const TaskSpace::Point&);

}  // namespace tactus
