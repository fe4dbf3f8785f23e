#include "kernel/reference/joint_space.hpp"

#include <limits>

namespace tactus {

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
    : duration_(T), order_(order_of(how, fields)) {
  const auto join = order_ == Interpolation::kLinear  ? tactus::linear
                    : order_ == Interpolation::kCubic ? tactus::cubic
                                                      : tactus::quintic;
  for (int i = 0; i < kDof; ++i) {
    q_[static_cast<std::size_t>(i)] =
        join({from.q[i], from.dq[i], from.ddq[i]}, {to.q[i], to.dq[i], to.ddq[i]}, T);
  }
  tau_from_ = from.tau;
  tau_to_ = to.tau;
}

JointSpace::Point JointSpace::Segment::corner() const {
  Point begin = at(0.0);
  if (order_ == Interpolation::kLinear) begin.dq.setZero();
  if (order_ != Interpolation::kQuintic) begin.ddq.setZero();
  return begin;
}

JointSpace::Point JointSpace::Segment::at(double t) const {
  Point point;
  for (int i = 0; i < kDof; ++i) {
    const Polynomial& q = position(i);
    const Polynomial dq = q.derivative();
    point.q[i] = q.at(t);
    point.dq[i] = dq.at(t);
    point.ddq[i] = dq.derivative().at(t);
  }
  point.tau = tau_from_ + (t / duration_) * (tau_to_ - tau_from_);
  return point;
}

JointSpace::Segment JointSpace::Segment::part(double begin, double duration) const {
  Segment part = *this;
  for (Polynomial& q : part.q_) q = q.from(begin);
  part.tau_from_ = at(begin).tau;
  part.tau_to_ = at(begin + duration).tau;
  part.duration_ = duration;
  return part;
}

JointSpace::Local JointSpace::Segment::local(double t) const {
  Local local;
  for (int i = 0; i < kDof; ++i) {
    const auto& c = position(i).c;
    local.d1[i] = c[1] + t * (2.0 * c[2] + t * (3.0 * c[3] + t * (4.0 * c[4] + t * 5.0 * c[5])));
    local.d2[i] = 2.0 * c[2] + t * (6.0 * c[3] + t * (12.0 * c[4] + t * 20.0 * c[5]));
    local.d3[i] = 6.0 * c[3] + t * (24.0 * c[4] + t * 60.0 * c[5]);
  }
  return local;
}

JointSpace::Difference JointSpace::difference(const Point& a, const Point& b) {
  return {a.q - b.q, a.dq - b.dq, a.ddq - b.ddq};
}

JointSpace::Point JointSpace::sum(const Point& b, const Difference& d) {
  return {b.q + d.x, b.dq + d.dx, b.ddq + d.ddx, b.tau};
}

JointSpace::Error JointSpace::error(const Point& desired, const Point& actual) {
  return {desired.q - actual.q, desired.dq - actual.dq, desired.ddq - actual.ddq,
          desired.tau - actual.tau};
}

}  // namespace tactus
