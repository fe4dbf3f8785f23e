// What the limits of the joints mean for a point and for a segment.
#include <algorithm>
#include <cmath>

#include "kernel/reference/joint_space.hpp"
#include "kernel/reference/limit_check.hpp"

namespace tactus {
namespace {

double largest(const Extremes& range) {
  return std::max(-range.min, range.max);
}

/// Largest magnitude of a polynomial on [0, T] by its `outer` bound, exact beyond `most`.
double peak(const Polynomial& polynomial, double T, const Extremes& outer, double most) {
  const double bound = largest(outer);
  return bound <= most ? bound : largest(extremes(polynomial, T));
}

/// Largest acceleration against the velocity, by bounds of both.
double against(const Extremes& dq, const Extremes& ddq) {
  if (dq.min >= 0.0) return std::max(0.0, -ddq.min);
  if (dq.max <= 0.0) return std::max(0.0, ddq.max);
  return largest(ddq);
}

}  // namespace

Verdict JointSpace::judge_waypoint(const Point& point, const Limits& limits) {
  for (int j = 0; j < kDof; ++j) {
    for (const double value : {point.q[j], point.dq[j], point.ddq[j], point.tau[j]}) {
      if (!std::isfinite(value)) return {Status::kReferenceNotFinite, -1, j, value, 0.0};
    }
    const double q = point.q[j], tau = point.tau[j];
    if (exceeds(q, limits.q_max[j])) return {Status::kPositionLimit, -1, j, q, limits.q_max[j]};
    if (exceeds(-q, -limits.q_min[j])) return {Status::kPositionLimit, -1, j, q, limits.q_min[j]};
    if (exceeds(std::abs(tau), limits.tau_max[j]))
      return {Status::kEffortLimit, -1, j, tau, limits.tau_max[j]};
  }
  return {};
}

Verdict JointSpace::judge(const Point& point, const Limits& limits) {
  Verdict verdict = judge_waypoint(point, limits);
  for (int j = 0; verdict.ok() && j < kDof; ++j) {
    const double dq = point.dq[j];
    if (exceeds(std::abs(dq), limits.dq_max[j]))
      verdict = {Status::kVelocityLimit, -1, j, dq, limits.dq_max[j]};
  }
  return verdict;
}

JointSpace::Peaks JointSpace::peaks(const Limits& limits) {
  Peaks peaks;
  for (int j = 0; j < kDof; ++j) {
    const std::size_t c = static_cast<std::size_t>(j);
    peaks.v[c] = limits.dq_max[j];
    peaks.a[c] = limits.ddq_max[j];
    peaks.j[c] = limits.dddq_max[j];
  }
  return peaks;
}

JointSpace::Measure JointSpace::measure(const Segment& segment, const Limits& limits,
                                        const Peaks& most) {
  const double T = segment.duration();
  Measure measure;
  for (int j = 0; j < kDof; ++j) {
    const std::size_t c = static_cast<std::size_t>(j);
    const Polynomial& q = segment.position(j);
    const Polynomial dq = q.derivative(), ddq = dq.derivative(), dddq = ddq.derivative();
    const Extremes velocity = hull(dq, T), acceleration = hull(ddq, T);
    measure.peaks.v[c] = peak(dq, T, velocity, most.v[c]);
    measure.peaks.a[c] = peak(ddq, T, acceleration, most.a[c]);
    measure.peaks.j[c] = peak(dddq, T, hull(dddq, T), most.j[c]);
    measure.slowing[c] = against(velocity, acceleration);
    Extremes room = hull(q, T);
    const bool inside = room.min >= limits.q_min[j] && room.max <= limits.q_max[j];
    if (!inside) room = extremes(q, T);
    measure.q_min[j] = room.min;
    measure.q_max[j] = room.max;
  }
  return measure;
}

Verdict JointSpace::judge_room(const Measure& measure, const Limits& limits) {
  for (int j = 0; j < kDof; ++j) {
    const double lowest = measure.q_min[j], highest = measure.q_max[j];
    if (exceeds(highest, limits.q_max[j]))
      return {Status::kPositionLimit, -1, j, highest, limits.q_max[j]};
    if (exceeds(-lowest, -limits.q_min[j]))
      return {Status::kPositionLimit, -1, j, lowest, limits.q_min[j]};
  }
  return {};
}

Verdict JointSpace::judge_end(const Point& end) {
  for (int j = 0; j < kDof; ++j) {
    if (exceeds(std::abs(end.dq[j]), kRest)) return {Status::kNotAtRest, -1, j, end.dq[j], 0.0};
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

Verdict JointSpace::judge_step(const Point& before, const Point& after, const Limits& limits,
                               double dt_s, Levels& level) {
  for (int j = 0; j < kDof; ++j) {
    double& steps = level[static_cast<std::size_t>(j)];
    steps = std::max(0.0, steps - limits.ddq_max[j] * dt_s) + std::abs(after.dq[j] - before.dq[j]);
    if (exceeds(steps, limits.velocity_step[j]))
      return {Status::kVelocityStep, -1, j, steps, limits.velocity_step[j]};
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
  return {std::max(a.velocity, b.velocity), std::max(a.acceleration, b.acceleration),
          std::max(a.jerk, b.jerk),         a.slowed || b.slowed,
          a.q_min.cwiseMin(b.q_min),        a.q_max.cwiseMax(b.q_max)};
}

JointSpace::Use JointSpace::use(const Point& held) {
  return {0.0, 0.0, 0.0, false, held.q, held.q};
}

JointSpace::Use JointSpace::use(const Measure& measure, const Peaks& limits) {
  Use use = {0.0, 0.0, 0.0, false, measure.q_min, measure.q_max};
  for (std::size_t c = 0; c < kChannels; ++c) {
    use.velocity = std::max(use.velocity, measure.peaks.v[c] / limits.v[c]);
    use.acceleration = std::max(use.acceleration, measure.peaks.a[c] / limits.a[c]);
    use.jerk = std::max(use.jerk, measure.peaks.j[c] / limits.j[c]);
  }
  return use;
}

/// The path is somewhere in its range, which admission found within limits, and not farther from
/// where it begins than it can get while the bridge lasts.
Verdict JointSpace::judge_room(const Point& begin, const Use& use, const Bridge& bridge,
                               const Limits& limits) {
  const double T = bridge.duration();
  for (int j = 0; j < kDof; ++j) {
    const Extremes beside = extremes(bridge.position(j), T);
    const double reach = use.velocity * limits.dq_max[j] * T;
    const double lowest =
        std::max({use.q_min[j], limits.q_min[j], begin.q[j] - reach}) + std::min(beside.min, 0.0);
    const double highest =
        std::min({use.q_max[j], limits.q_max[j], begin.q[j] + reach}) + std::max(beside.max, 0.0);
    if (exceeds(highest, limits.q_max[j]))
      return {Status::kPositionLimit, -1, j, highest, limits.q_max[j]};
    if (exceeds(-lowest, -limits.q_min[j]))
      return {Status::kPositionLimit, -1, j, lowest, limits.q_min[j]};
  }
  return {};
}

}  // namespace tactus
