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

}  // namespace tactus
