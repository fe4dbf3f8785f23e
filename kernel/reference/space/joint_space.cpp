#include "kernel/reference/space/joint_space.hpp"

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
