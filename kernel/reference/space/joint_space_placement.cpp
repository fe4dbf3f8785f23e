// JointSpace: references of a client that gives only some of the joints.
#include "kernel/reference/space/joint_space.hpp"

namespace tactus {

JointSpace::Placement JointSpace::latch(const Header& header, const Point& reference,
                                        const Limits& limits) {
  return {header.held, header.held != 0 ? rest_of(reference, limits).q : reference.q};
}

JointSpace::Placement JointSpace::anywhere(const Header& header, const Limits& limits) {
  return {header.held, 0.5 * (limits.q_min + limits.q_max)};
}

JointSpace::Point JointSpace::only(Fields given, const Point& point) {
  Point known = point;
  if (!(given & kVelocityField)) known.dq.setZero();
  if (!(given & kAccelerationField)) known.ddq.setZero();
  if (!(given & kEffortField)) known.tau.setZero();
  return known;
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

}  // namespace tactus
