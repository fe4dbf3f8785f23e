// What the references of a client mean who gives only some of the joints.
#include "kernel/reference/joint_space.hpp"

namespace tactus {

JointSpace::Latched JointSpace::latch(const Terms& terms, const Point& reference) {
  return {terms.held, reference.q};
}

JointSpace::Latched JointSpace::anywhere(const Terms& terms, const Limits& limits) {
  return {terms.held, 0.5 * (limits.q_min + limits.q_max)};
}

JointSpace::Point JointSpace::only(Fields given, const Point& point) {
  Point known = point;
  if (!(given & kVelocityField)) known.dq.setZero();
  if (!(given & kAccelerationField)) known.ddq.setZero();
  if (!(given & kEffortField)) known.tau.setZero();
  return known;
}

JointSpace::Point JointSpace::placed(const Point& given, const Latched& terms) {
  Point point = given;
  for (int j = 0; j < kDof; ++j) {
    if ((terms.held >> j & 1U) == 0) continue;
    point.q[j] = terms.q[j];
    point.dq[j] = point.ddq[j] = point.tau[j] = 0.0;
  }
  return point;
}

JointSpace::Use JointSpace::placed(const Use& given, const Latched& terms) {
  Use use = given;
  for (int j = 0; j < kDof; ++j) {
    if ((terms.held >> j & 1U) != 0) use.q_min[j] = use.q_max[j] = terms.q[j];
  }
  return use;
}

}  // namespace tactus
