#include "kernel/reference/space/joint_space.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel/reference/space/limit_check.hpp"

namespace tactus {
namespace {

double largest(const Extremes& range) {
  return std::max(-range.min, range.max);
}

/// Returns the largest magnitude of a polynomial on [0, T]: its `outer` bound if that is within
/// `most` or `quick` is set, else the exact value.
double peak(const Polynomial& polynomial, double T, const Extremes& outer, double most,
            bool quick) {
  const double bound = largest(outer);
  return quick || bound <= most ? bound : largest(extremes(polynomial, T));
}

/// Returns the largest acceleration against the velocity, by bounds of both.
double against(const Extremes& dq, const Extremes& ddq) {
  if (dq.min >= 0.0) return std::max(0.0, -ddq.min);
  if (dq.max <= 0.0) return std::max(0.0, ddq.max);
  return largest(ddq);
}

}  // namespace

JointSpace::Band JointSpace::Band::merged(const Band& goal, const Band& defaults) {
  Band band;
  for (int j = 0; j < kDof; ++j) band.q[j] = merge_tolerance(goal.q[j], defaults.q[j]);
  return band;
}

bool JointSpace::Point::finite() const {
  return q.allFinite() && dq.allFinite() && ddq.allFinite() && tau.allFinite();
}

JointSpace::Point JointSpace::Point::at_rest() const {
  Point rest;
  rest.q = q;
  return rest;
}

bool JointSpace::Point::standing() const {
  return dq == JointVector::Zero() && ddq == JointVector::Zero();
}

bool JointSpace::Point::idle() const {
  return standing() && tau == JointVector::Zero();
}

JointSpace::Point JointSpace::Point::stopped() const {
  Point still = at_rest();
  still.tau = tau;
  return still;
}

JointSpace::Point JointSpace::Point::as_measured(Fields fields) const {
  const JointVector none = JointVector::Constant(std::numeric_limits<double>::quiet_NaN());
  return {q, fields & kVelocityField ? dq : none, fields & kAccelerationField ? ddq : none,
          fields & kEffortField ? tau : none};
}

JointSpace::Point JointSpace::Point::at_rate(double rate, double slope) const {
  return {q, rate * dq, (rate * rate) * ddq + slope * dq, tau};
}

JointSpace::Segment::Segment(const Point& from, const Point& to, double T, Interpolation how,
                             Fields fields)
    : order_(order_of(how, fields)),
      q_(join<JointVector>(order_, {from.q, from.dq, from.ddq}, {to.q, to.dq, to.ddq}, T)),
      tau_from_(from.tau),
      tau_to_(to.tau),
      duration_(T) {}

JointSpace::Point JointSpace::Segment::corner() const {
  Point begin = at(0.0);
  if (order_ == Interpolation::kLinear) begin.dq.setZero();
  if (order_ != Interpolation::kQuintic) begin.ddq.setZero();
  return begin;
}

JointSpace::Point JointSpace::Segment::at(double t) const {
  const auto here = q_.from(t).c;
  Point point;
  point.q = here[0];
  point.dq = here[1];
  point.ddq = 2.0 * here[2];
  point.tau = tau_from_ + (t / duration_) * (tau_to_ - tau_from_);
  return point;
}

JointSpace::Segment JointSpace::Segment::part(double begin, double duration) const {
  Segment part = *this;
  part.q_ = q_.from(begin);
  part.tau_from_ = at(begin).tau;
  part.tau_to_ = at(begin + duration).tau;
  part.duration_ = duration;
  return part;
}

JointSpace::Local JointSpace::Segment::local(double t) const {
  const auto here = q_.from(t).c;
  return {here[1], 2.0 * here[2], 6.0 * here[3]};
}

JointSpace::Error JointSpace::error(const Point& desired, const Point& actual) {
  return {desired.q - actual.q, desired.dq - actual.dq, desired.ddq - actual.ddq,
          desired.tau - actual.tau};
}

JointSpace::Placement JointSpace::latch(const Header& header, const Point& reference,
                                        const Limits& limits) {
  return {header.held, header.held != 0 ? rest_of(reference, limits).q : reference.q};
}

JointSpace::Placement JointSpace::anywhere(const Header& header, const Limits& limits) {
  return {header.held, 0.5 * (limits.q_min + limits.q_max)};
}

JointSpace::Point JointSpace::only(Fields given, const double* numbers) {
  const auto vector = [given, numbers](Fields field, int first) -> JointVector {
    return given & field ? JointVector(numbers + first) : JointVector::Zero();
  };
  return {JointVector(numbers), vector(kVelocityField, kDof), vector(kAccelerationField, 2 * kDof),
          vector(kEffortField, 3 * kDof)};
}

JointSpace::Point JointSpace::placed(const Point& given, const Placement& placement) {
  Point point = given;
  for (int j = 0; j < kDof; ++j) {
    if ((placement.held >> j & 1U) == 0) continue;
    point.q[j] = placement.q[j];
    point.dq[j] = point.ddq[j] = point.tau[j] = 0.0;
  }
  return point;
}

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

Verdict JointSpace::saturate(Point& point, const Limits& limits) {
  Verdict first;
  for (int j = 0; j < kDof; ++j) {
    const Verdict saturation =
        tactus::saturate(point.q[j], point.dq[j], limits.q_min[j], limits.q_max[j], j);
    if (saturation.ok()) continue;
    point.ddq[j] = 0.0;
    if (first.ok()) first = saturation;
  }
  return first;
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
                                        const Peaks& most, Accuracy accuracy) {
  const bool quick = accuracy == Accuracy::kQuick;
  const double T = segment.duration();
  Measure measure;
  for (int j = 0; j < kDof; ++j) {
    const std::size_t c = static_cast<std::size_t>(j);
    const Polynomial q = segment.position(j);
    const Polynomial dq = q.derivative(), ddq = dq.derivative(), dddq = ddq.derivative();
    const Extremes velocity = hull(dq, T), acceleration = hull(ddq, T);
    measure.peaks.v[c] = peak(dq, T, velocity, most.v[c], quick);
    measure.peaks.a[c] = peak(ddq, T, acceleration, most.a[c], quick);
    measure.peaks.j[c] = peak(dddq, T, hull(dddq, T), most.j[c], quick);
    measure.slowing[c] = against(velocity, acceleration);
    Extremes room = hull(q, T);
    const bool inside = room.min >= limits.q_min[j] && room.max <= limits.q_max[j];
    if (!inside && !quick) room = extremes(q, T);
    measure.q_min[j] = room.min;
    measure.q_max[j] = room.max;
  }
  return measure;
}

Verdict JointSpace::judge_room(const Measure& measure, const Limits& limits, const Point& from) {
  for (int j = 0; j < kDof; ++j) {
    const double lowest = measure.q_min[j], highest = measure.q_max[j];
    if (exceeds(highest, std::max(limits.q_max[j], from.q[j])))
      return {Status::kPositionLimit, -1, j, highest, limits.q_max[j]};
    if (exceeds(-lowest, -std::min(limits.q_min[j], from.q[j])))
      return {Status::kPositionLimit, -1, j, lowest, limits.q_min[j]};
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

Verdict JointSpace::judge_error(const Point& desired, const Point& measured, const Band& band,
                                Status code) {
  for (int j = 0; j < kDof; ++j) {
    const double error = std::abs(desired.q[j] - measured.q[j]);
    if (band.q[j] > 0.0 && !(error <= band.q[j])) return {code, -1, j, error, band.q[j]};
  }
  return {};
}

}  // namespace tactus
