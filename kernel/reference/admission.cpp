#include "kernel/reference/admission.hpp"

#include <cmath>

#include "kernel/reference/joint_space.hpp"

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

}  // namespace

template <class Space>
Verdict admit(Trajectory<Space>& trajectory, const AdmissionSettings<Space>& settings) {
  if (trajectory.count < 1 || trajectory.count > trajectory.capacity)
    return {Status::kReferenceSize, -1, -1, static_cast<double>(trajectory.count),
            static_cast<double>(trajectory.capacity)};
  Verdict verdict = admit_times(trajectory, settings.period_s);
  trajectory.use = {};
  for (int i = 0; verdict.ok() && i < trajectory.count; ++i) {
    verdict = at_waypoint(Space::judge(trajectory.waypoints[i].point, settings.limits), i);
    if (!verdict.ok() || i == 0) continue;
    const typename Space::Segment segment = trajectory.segment(i);
    verdict = at_waypoint(Space::judge(segment, settings.limits, 1.0 - settings.stop_reserve), i);
    if (verdict.ok()) trajectory.use = Space::use(segment, settings.limits, trajectory.use);
  }
  if (!verdict.ok()) return verdict;
  const int last = trajectory.count - 1;
  return at_waypoint(Space::judge_end(trajectory.waypoints[last].point), last);
}

template Verdict admit(Trajectory<JointSpace>&, const AdmissionSettings<JointSpace>&);

}  // namespace tactus
