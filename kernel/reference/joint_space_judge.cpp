// What the limits of the joints mean for a point and for a segment.
#include <algorithm>
#include <cmath>

#include "kernel/reference/joint_space.hpp"
#include "kernel/reference/limit_check.hpp"

namespace tactus {
namespace {

Verdict symmetric(const Polynomial& polynomial, double T, double limit, Status status, int axis) {
  return bounded(polynomial, T, -limit, limit, status, axis);
}

/// Largest magnitude of a polynomial on [0, T] over `limit`, exact where it is more than `known`.
double ratio(const Polynomial& polynomial, double T, double limit, double known) {
  const auto largest = [](const Extremes& e) { return std::max(-e.min, e.max); };
  if (largest(hull(polynomial, T)) <= known * limit) return known;
  return std::max(known, largest(extremes(polynomial, T)) / limit);
}

}  // namespace

Verdict JointSpace::judge(const Point& point, const Limits& limits) {
  for (int j = 0; j < kDof; ++j) {
    for (const double value : {point.q[j], point.dq[j], point.ddq[j], point.tau[j]}) {
      if (!std::isfinite(value)) return {Status::kReferenceNotFinite, -1, j, value, 0.0};
    }
    const double q = point.q[j], dq = point.dq[j], tau = point.tau[j];
    if (exceeds(q, limits.q_max[j])) return {Status::kPositionLimit, -1, j, q, limits.q_max[j]};
    if (exceeds(-q, -limits.q_min[j])) return {Status::kPositionLimit, -1, j, q, limits.q_min[j]};
    if (exceeds(std::abs(dq), limits.dq_max[j]))
      return {Status::kVelocityLimit, -1, j, dq, limits.dq_max[j]};
    if (exceeds(std::abs(tau), limits.tau_max[j]))
      return {Status::kEffortLimit, -1, j, tau, limits.tau_max[j]};
  }
  return {};
}

Verdict JointSpace::judge(const Segment& segment, const Limits& limits, double share) {
  const double T = segment.duration();
  for (int j = 0; j < kDof; ++j) {
    const Polynomial& q = segment.position(j);
    const Polynomial dq = q.derivative(), ddq = dq.derivative(), dddq = ddq.derivative();
    Verdict verdict = bounded(q, T, limits.q_min[j], limits.q_max[j], Status::kPositionLimit, j);
    if (verdict.ok()) verdict = symmetric(dq, T, limits.dq_max[j], Status::kVelocityLimit, j);
    if (verdict.ok())
      verdict = symmetric(ddq, T, share * limits.ddq_max[j], Status::kAccelerationLimit, j);
    if (verdict.ok())
      verdict = symmetric(dddq, T, share * limits.dddq_max[j], Status::kJerkLimit, j);
    if (!verdict.ok()) return verdict;
  }
  return {};
}

Verdict JointSpace::judge_end(const Point& end) {
  for (int j = 0; j < kDof; ++j) {
    if (exceeds(std::abs(end.dq[j]), kRest)) return {Status::kNotAtRest, -1, j, end.dq[j], 0.0};
    if (exceeds(std::abs(end.ddq[j]), kRest)) return {Status::kNotAtRest, -1, j, end.ddq[j], 0.0};
  }
  return {};
}

Verdict JointSpace::judge_near(const Point& a, const Point& b, const Tolerance& tolerance) {
  for (int j = 0; j < kDof; ++j) {
    const double distance = std::abs(a.q[j] - b.q[j]);
    if (!(distance <= tolerance.q[j]))
      return {Status::kStartTolerance, -1, j, distance, tolerance.q[j]};
  }
  return {};
}

Verdict JointSpace::judge_step(const Point& before, const Point& after, const Limits& limits) {
  for (int j = 0; j < kDof; ++j) {
    const double step = after.dq[j] - before.dq[j];
    if (exceeds(std::abs(step), limits.velocity_step[j]))
      return {Status::kVelocityStep, -1, j, step, limits.velocity_step[j]};
  }
  return {};
}

Verdict JointSpace::judge_reach(const Point& from, const Point& to, const Limits& limits,
                                double dt_s) {
  for (int j = 0; j < kDof; ++j) {
    const double velocity = (to.q[j] - from.q[j]) / dt_s;
    if (exceeds(std::abs(velocity), limits.dq_max[j]))
      return {Status::kVelocityLimit, -1, j, velocity, limits.dq_max[j]};
  }
  return {};
}

Verdict JointSpace::judge_error(const Point& desired, const Point& measured, const Band& band,
                                Status code) {
  for (int j = 0; j < kDof; ++j) {
    const double error = std::abs(desired.q[j] - measured.q[j]);
    if (band.q[j] > 0.0 && !(error <= band.q[j])) return {code, -1, j, error, band.q[j]};
  }
  return {};
}

Verdict JointSpace::judge_stopped(const Point& measured, double limit) {
  for (int j = 0; j < kDof; ++j) {
    const double speed = std::abs(measured.dq[j]);
    if (limit > 0.0 && !(speed <= limit)) return {Status::kGoalTolerance, -1, j, speed, limit};
  }
  return {};
}

JointSpace::Use JointSpace::Use::largest(const Use& a, const Use& b) {
  return {PathUse::largest(a, b), a.q_min.cwiseMin(b.q_min), a.q_max.cwiseMax(b.q_max)};
}

JointSpace::Use JointSpace::use(const Point& held) {
  return {PathUse(), held.q, held.q};
}

JointSpace::Use JointSpace::use(const Segment& segment, const Limits& limits, const Use& known) {
  const double T = segment.duration();
  Use use = known;
  for (int j = 0; j < kDof; ++j) {
    const Polynomial dq = segment.position(j).derivative();
    const Polynomial ddq = dq.derivative(), dddq = ddq.derivative();
    const double v = limits.dq_max[j], a = limits.ddq_max[j], jerk = limits.dddq_max[j];
    const Extremes room = hull(segment.position(j), T);
    use.q_min[j] = std::min(use.q_min[j], room.min);
    use.q_max[j] = std::max(use.q_max[j], room.max);
    use.velocity = ratio(dq, T, v, use.velocity);
    use.velocity_by_a = ratio(dq, T, a, use.velocity_by_a);
    use.velocity_by_j = ratio(dq, T, jerk, use.velocity_by_j);
    use.acceleration = ratio(ddq, T, a, use.acceleration);
    use.acceleration_by_j = ratio(ddq, T, jerk, use.acceleration_by_j);
    use.jerk = ratio(dddq, T, jerk, use.jerk);
  }
  return use;
}

}  // namespace tactus
