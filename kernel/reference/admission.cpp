#include "kernel/reference/admission.hpp"

#include <cmath>

namespace tactus {
namespace {

// Numbers in a file are rounded to some ten digits; a limit reached exactly must not be refused for
// that.
constexpr double kRounding = 1e-9;
// Largest velocity or acceleration that still counts as standing, rad/s and rad/s^2.
constexpr double kRest = 1e-6;

Verdict refuse(Status status, int waypoint, int joint = -1, double value = 0.0,
               double limit = 0.0) {
  return {status, waypoint, joint, value, limit};
}

/// Comparisons are written so that NaN fails them.
bool exceeds(double value, double limit) {
  return !(value <= limit + kRounding);
}

/// Range of one polynomial against lo and hi, both of which it may touch.
Verdict bounded(const Polynomial& polynomial, double T, double lo, double hi, Status status,
                int waypoint, int joint) {
  const Extremes outer = hull(polynomial, T);
  if (outer.max <= hi && outer.min >= lo) return {};
  const Extremes found = extremes(polynomial, T);
  if (exceeds(found.max, hi)) return refuse(status, waypoint, joint, found.max, hi);
  if (exceeds(-found.min, -lo)) return refuse(status, waypoint, joint, found.min, lo);
  return {};
}

Verdict admit_times(const Trajectory<JointSpace>& trajectory, double period_s) {
  const double spacing = period_s / kMaxSegmentsPerCycle;
  double earlier = -spacing;  // the first waypoint may be at zero
  for (int i = 0; i < trajectory.count; ++i) {
    const double time = trajectory.waypoints[i].time_s;
    if (!std::isfinite(time)) return refuse(Status::kReferenceNotFinite, i, -1, time);
    if (exceeds(earlier + spacing, time))
      return refuse(Status::kReferenceTime, i, -1, time, earlier + spacing);
    earlier = time;
  }
  return {};
}

/// The last waypoint: nothing follows it, so whoever arrives there must stand.
Verdict admit_end(const Trajectory<JointSpace>& trajectory) {
  const int last = trajectory.count - 1;
  const JointSpace::Point& end = trajectory.waypoints[last].point;
  for (int j = 0; j < kDof; ++j) {
    if (exceeds(std::abs(end.dq[j]), kRest))
      return refuse(Status::kNotAtRest, last, j, end.dq[j], 0.0);
    if (exceeds(std::abs(end.ddq[j]), kRest))
      return refuse(Status::kNotAtRest, last, j, end.ddq[j], 0.0);
  }
  return {};
}

}  // namespace

Verdict admit(const JointSpace::Segment& segment, int waypoint, const JointLimits& limits) {
  const double T = segment.duration();
  for (int j = 0; j < kDof; ++j) {
    const Polynomial& q = segment.position(j);
    const Polynomial dq = q.derivative(), ddq = dq.derivative();
    Verdict verdict =
        bounded(q, T, limits.q_min[j], limits.q_max[j], Status::kPositionLimit, waypoint, j);
    if (verdict.ok())
      verdict =
          bounded(dq, T, -limits.dq_max[j], limits.dq_max[j], Status::kVelocityLimit, waypoint, j);
    if (verdict.ok())
      verdict = bounded(ddq, T, -limits.ddq_max[j], limits.ddq_max[j], Status::kAccelerationLimit,
                        waypoint, j);
    if (!verdict.ok()) return verdict;
  }
  return {};
}

Verdict admit(const JointSpace::Point& point, const JointLimits& limits) {
  for (int j = 0; j < kDof; ++j) {
    for (const double value : {point.q[j], point.dq[j], point.ddq[j], point.tau[j]}) {
      if (!std::isfinite(value)) return refuse(Status::kReferenceNotFinite, -1, j, value);
    }
    const double q = point.q[j], dq = point.dq[j], tau = point.tau[j];
    if (exceeds(q, limits.q_max[j]))
      return refuse(Status::kPositionLimit, -1, j, q, limits.q_max[j]);
    if (exceeds(-q, -limits.q_min[j]))
      return refuse(Status::kPositionLimit, -1, j, q, limits.q_min[j]);
    if (exceeds(std::abs(dq), limits.dq_max[j]))
      return refuse(Status::kVelocityLimit, -1, j, dq, limits.dq_max[j]);
    if (exceeds(std::abs(tau), limits.tau_max[j]))
      return refuse(Status::kEffortLimit, -1, j, tau, limits.tau_max[j]);
  }
  return {};
}

Verdict within(const JointSpace::Point& a, const JointSpace::Point& b,
               const JointVector& tolerance) {
  for (int j = 0; j < kDof; ++j) {
    const double distance = std::abs(a.q[j] - b.q[j]);
    if (!(distance <= tolerance[j]))
      return refuse(Status::kStartTolerance, 0, j, distance, tolerance[j]);
  }
  return {};
}

Verdict admit(const Trajectory<JointSpace>& trajectory, const AdmissionSettings& settings) {
  if (trajectory.count < 1 || trajectory.count > trajectory.capacity)
    return refuse(Status::kReferenceSize, -1, -1, trajectory.count, trajectory.capacity);
  Verdict verdict = admit_times(trajectory, settings.period_s);
  for (int i = 0; verdict.ok() && i < trajectory.count; ++i) {
    verdict = admit(trajectory.waypoints[i].point, settings.limits);
    verdict.waypoint = i;
    if (verdict.ok() && i > 0) verdict = admit(trajectory.segment(i), i, settings.limits);
  }
  return verdict.ok() ? admit_end(trajectory) : verdict;
}

}  // namespace tactus
