#include "kernel/reference/motion/admission.hpp"

#include <cmath>

#include "kernel/reference/motion/admission_room.hpp"
#include "kernel/reference/motion/monotone.hpp"
#include "kernel/reference/space/joint_space.hpp"
#include "kernel/reference/space/judge_channels.hpp"
#include "kernel/reference/space/task_space.hpp"

namespace tactus {
namespace {

// Times in a file are rounded to about ten digits; a spacing met exactly must not be refused.
constexpr double kRounding_s = 1e-9;

Verdict at_waypoint(Verdict verdict, int waypoint) {
  verdict.waypoint = waypoint;
  return verdict;
}

template <class Space>
Verdict admit_times(const Trajectory<Space>& trajectory, double period_s) {
  for (int i = 0; i < trajectory.count; ++i) {
    const Verdict verdict = admit_time(trajectory, i, trajectory.time_s(i), period_s);
    if (!verdict.ok()) return verdict;
  }
  return {};
}

}  // namespace

template <class Space>
Verdict admit_time(const Trajectory<Space>& trajectory, int index, double time_s, double period_s) {
  const double earliest =
      index == 0 ? 0.0 : trajectory.time_s(index - 1) + period_s / kMaxSegmentsPerCycle;
  if (!std::isfinite(time_s)) return {Status::kReferenceNotFinite, index, -1, time_s, 0.0};
  if (!(time_s >= earliest - kRounding_s))
    return {Status::kReferenceTime, index, -1, time_s, earliest};
  if (time_s > kLongestTrajectory_s)
    return {Status::kReferenceTime, index, -1, time_s, kLongestTrajectory_s};
  return {};
}

template <class Space>
Verdict admit_waypoint(const Trajectory<Space>& trajectory, int index,
                       const AdmissionSettings<Space>& settings, Admitted<Space>& so_far) {
  const typename Space::Limits limits = Space::known_limits(trajectory.header, settings.limits);
  const typename Space::Placement placement = Space::anywhere(trajectory.header, limits);
  const typename Space::Point point = trajectory.point(index, placement);
  Verdict verdict = Space::judge_waypoint(point, limits);
  if (verdict.ok() && index == 0)
    so_far.extent = Space::Extent::largest(so_far.extent, Space::extent_of(point));
  if (!verdict.ok() || index == 0) return at_waypoint(verdict, index);
  const typename Space::Segment segment = trajectory.segment(index, placement);
  const typename Space::Peaks most = Space::peaks(limits).reserved(1.0 - settings.stop_reserve);
  const typename Space::Measure measure = Space::measure(segment, limits, most);
  const double pause_s =
      index > 1 ? trajectory.time_s(index - 1) - trajectory.time_s(index - 2) : 0.0;
  verdict = Space::judge_room(measure, limits, point);  // within them
  if (verdict.ok() && trajectory.exact) verdict = judge(measure.peaks, most, Space::kChannelSize);
  if (verdict.ok())
    verdict = Space::judge_step(so_far.end, segment.at(0.0), limits, pause_s, so_far.steps);
  if (!verdict.ok()) return at_waypoint(verdict, index);
  const OwnRoom own = own_room(measure.peaks, most, Space::kChannelSize);
  if (own.most < so_far.room) {
    so_far.room = own.most;
    so_far.worst = at_waypoint(own.worst, index);
  }
  so_far.extent = Space::Extent::largest(so_far.extent, Space::extent_of(measure));
  so_far.extent.slowed = so_far.extent.slowed || own.most < 1.0;
  so_far.end = segment.at(segment.duration());
  return {};
}

template <class Space>
Verdict admit_end(const Trajectory<Space>& trajectory, int last,
                  const AdmissionSettings<Space>& settings, Admitted<Space> so_far) {
  const typename Space::Point end =
      trajectory.point(last, Space::anywhere(trajectory.header, settings.limits));
  Verdict verdict = judge_end<Space>(end);
  if (verdict.ok() && last > 0) {
    const double pause_s = trajectory.time_s(last) - trajectory.time_s(last - 1);
    verdict = Space::judge_step(so_far.end, end.at_rest(), settings.limits, pause_s, so_far.steps);
  }
  return at_waypoint(verdict, last);
}

template <class Space>
Admitted<Space> nothing_yet(const Trajectory<Space>& trajectory,
                            const AdmissionSettings<Space>& settings) {
  const typename Space::Placement placement = Space::anywhere(trajectory.header, settings.limits);
  Admitted<Space> nothing;
  nothing.end = trajectory.point(0, placement).at_rest();
  if (trajectory.count < 2) return nothing;
  const typename Space::Segment first = trajectory.segment(1, placement);
  nothing.end = trajectory.time_s(0) > 0.0 ? first.at(0.0) : first.corner();
  return nothing;
}

template <class Space>
Verdict admit_part(const Trajectory<Space>& trajectory, int first, int last,
                   const AdmissionSettings<Space>& settings, const Admitted<Space>& part,
                   double& longer) {
  longer = 0.0;
  if (part.room < 1.0) {
    const float begin = set_rooms(trajectory, settings, first, first, last, 1.0);
    longer = stretch(trajectory, settings, first, last, begin);
  }
  for (int i = first + 1; i <= last; ++i) {
    WaypointRooms& rooms = trajectory.rooms(i);
    rooms.room = rooms.halfway = 0.0F;
  }
  return longer <= settings.max_stretch ? Verdict() : part.worst;
}

/// Gives a trajectory of kMonotone velocities with which it does not overshoot.
template <class Space>
Verdict shape_monotone(const Trajectory<Space>& trajectory,
                       const AdmissionSettings<Space>& settings) {
  if (trajectory.interpolation != Interpolation::kMonotone) return {};
  if (trajectory.open) return {Status::kNotStreamable};
  const typename Space::Limits limits = Space::known_limits(trajectory.header, settings.limits);
  const typename Space::Placement placement = Space::anywhere(trajectory.header, limits);
  for (int i = 0; i < trajectory.count; ++i) {
    const Verdict verdict = Space::judge_waypoint(trajectory.point(i, placement), limits);
    if (!verdict.ok()) return at_waypoint(verdict, i);
  }
  make_monotone(trajectory);
  return {};
}

template <class Space>
Verdict admit(Trajectory<Space>& trajectory, const AdmissionSettings<Space>& settings,
              Admitted<Space>& whole) {
  if (trajectory.count < 1 || trajectory.count > trajectory.capacity)
    return {Status::kReferenceSize, -1, -1, static_cast<double>(trajectory.count),
            static_cast<double>(trajectory.capacity)};
  if (trajectory.capacity > kMostWaypoints)
    return {Status::kReferenceSize, -1, -1, static_cast<double>(trajectory.capacity),
            static_cast<double>(kMostWaypoints)};
  if (!trajectory.holds_fields()) return {Status::kReferenceSize};
  Verdict verdict = admit_times(trajectory, settings.period_s);
  if (verdict.ok()) verdict = shape_monotone(trajectory, settings);
  if (!verdict.ok()) return verdict;
  whole = nothing_yet(trajectory, settings);
  for (int i = 0; i < trajectory.count; ++i) {
    verdict = admit_waypoint(trajectory, i, settings, whole);
    if (!verdict.ok()) return verdict;
  }
  const int last = trajectory.count - 1;
  if (!trajectory.open) verdict = admit_end(trajectory, last, settings, whole);
  if (!verdict.ok()) return verdict;
  trajectory.extent = whole.extent;
  trajectory.stretch = 0.0;
  if (whole.room < 1.0) {
    trajectory.rooms(0).room = set_rooms(trajectory, settings, 0, 0, last, 1.0);
    trajectory.stretch = stretch(trajectory, settings, 0, last, trajectory.rooms(0).room);
    if (!(trajectory.stretch <= settings.max_stretch)) return whole.worst;
  }
  if (trajectory.open) trajectory.rooms(0).room = set_rooms(trajectory, settings, 0, 0, last, 0.0);
  return {};
}

#define TACTUS_ADMISSION(Space)                                                                    \
  template Verdict admit(Trajectory<Space>&, const AdmissionSettings<Space>&, Admitted<Space>&);   \
  template Admitted<Space> nothing_yet(const Trajectory<Space>&, const AdmissionSettings<Space>&); \
  template Verdict admit_waypoint(const Trajectory<Space>&, int, const AdmissionSettings<Space>&,  \
                                  Admitted<Space>&);                                               \
  template Verdict admit_end(const Trajectory<Space>&, int, const AdmissionSettings<Space>&,       \
                             Admitted<Space>);                                                     \
  template Verdict admit_part(const Trajectory<Space>&, int, int, const AdmissionSettings<Space>&, \
                              const Admitted<Space>&, double&);                                    \
  template Verdict admit_time(const Trajectory<Space>&, int, double, double)

TACTUS_ADMISSION(JointSpace);
TACTUS_ADMISSION(TaskSpace);
#undef TACTUS_ADMISSION

}  // namespace tactus
