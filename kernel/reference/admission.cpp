#include "kernel/reference/admission.hpp"

#include <cmath>

#include "kernel/reference/joint_space.hpp"
#include "kernel/reference/monotone.hpp"
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
                       typename Space::Use& use) {
  const typename Space::Limits limits = Space::known_limits(trajectory.terms, settings.limits);
  const typename Space::Latched terms = Space::anywhere(trajectory.terms, limits);
  Verdict verdict = Space::judge(trajectory.point(index, terms), limits);
  if (verdict.ok() && index > 0) {
    const typename Space::Segment segment = trajectory.segment(index, terms);
    verdict = Space::judge(segment, limits, 1.0 - settings.stop_reserve);
    if (verdict.ok()) verdict = Space::judge_step(before, segment.at(0.0), limits);
    if (verdict.ok()) use = Space::use(segment, limits, use);
    if (verdict.ok()) before = segment.at(segment.duration());
  }
  return at_waypoint(verdict, index);
}

template <class Space>
Verdict admit_end(const Trajectory<Space>& trajectory, int last,
                  const AdmissionSettings<Space>& settings, const typename Space::Point& before) {
  const typename Space::Point end =
      trajectory.point(last, Space::anywhere(trajectory.terms, settings.limits));
  Verdict verdict = Space::judge_end(end);
  if (verdict.ok() && last > 0) verdict = Space::judge_step(before, end.at_rest(), settings.limits);
  return at_waypoint(verdict, last);
}

/// What comes before the first segment. A first waypoint at zero is left from rest; the way to a
/// later one is judged when it begins.
template <class Space>
typename Space::Point before_first(const Trajectory<Space>& trajectory,
                                   const typename Space::Limits& limits) {
  const typename Space::Latched terms = Space::anywhere(trajectory.terms, limits);
  if (trajectory.count < 2) return trajectory.point(0, terms).at_rest();
  const typename Space::Segment first = trajectory.segment(1, terms);
  return trajectory.at(0).time_s > 0.0 ? first.at(0.0) : first.corner();
}

/// Gives a trajectory that asks for it velocities with which it does not overshoot.
template <class Space>
Verdict shape_monotone(const Trajectory<Space>& trajectory,
                       const AdmissionSettings<Space>& settings) {
  if (trajectory.interpolation != Interpolation::kMonotone) return {};
  if (trajectory.open) return {Status::kNotStreamable};
  const typename Space::Limits limits = Space::known_limits(trajectory.terms, settings.limits);
  const typename Space::Latched terms = Space::anywhere(trajectory.terms, limits);
  for (int i = 0; i < trajectory.count; ++i) {
    const Verdict verdict = Space::judge(trajectory.point(i, terms), limits);
    if (!verdict.ok()) return at_waypoint(verdict, i);
  }
  make_monotone(trajectory);
  return {};
}

template <class Space>
Verdict admit(Trajectory<Space>& trajectory, const AdmissionSettings<Space>& settings) {
  if (trajectory.count < 1 || trajectory.count > trajectory.capacity)
    return {Status::kReferenceSize, -1, -1, static_cast<double>(trajectory.count),
            static_cast<double>(trajectory.capacity)};
  Verdict verdict = admit_times(trajectory, settings.period_s);
  if (verdict.ok()) verdict = shape_monotone(trajectory, settings);
  if (!verdict.ok()) return verdict;
  trajectory.use = {};
  typename Space::Point before = before_first(trajectory, settings.limits);
  for (int i = 0; i < trajectory.count; ++i) {
    verdict = admit_waypoint(trajectory, i, settings, before, trajectory.use);
    if (!verdict.ok()) return verdict;
  }
  if (trajectory.open) return {};
  return admit_end(trajectory, trajectory.count - 1, settings, before);
}

template Verdict admit(Trajectory<JointSpace>&, const AdmissionSettings<JointSpace>&);
template Verdict admit_waypoint(const Trajectory<JointSpace>&, int,
                                const AdmissionSettings<JointSpace>&, JointSpace::Point&,
                                JointSpace::Use&);
template Verdict admit_end(const Trajectory<JointSpace>&, int, const AdmissionSettings<JointSpace>&,
                           const JointSpace::Point&);
template Verdict admit(Trajectory<TaskSpace>&, const AdmissionSettings<TaskSpace>&);
template Verdict admit_waypoint(const Trajectory<TaskSpace>&, int,
                                const AdmissionSettings<TaskSpace>&, TaskSpace::Point&,
                                TaskSpace::Use&);
template Verdict admit_end(const Trajectory<TaskSpace>&, int, const AdmissionSettings<TaskSpace>&,
                           const TaskSpace::Point&);

}  // namespace tactus
