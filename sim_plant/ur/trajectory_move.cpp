#include "sim_plant/ur/trajectory_move.hpp"

namespace tactus::ur {
namespace {

using Point = std::array<std::int32_t, kTrajectoryInts>;

Vector6 six(const Point& point, std::size_t first) {
  Vector6 values;
  for (int i = 0; i < 6; ++i) values[i] = point[first + static_cast<std::size_t>(i)] / kFixedPoint;
  return values;
}

/// A pose, or joints that stand for one.
Frame frame(const Vector6& values, bool joints, const Motion& motion) {
  return joints ? forward(values) * motion.tool() : Frame::of(values);
}

}  // namespace

bool read_move(const Point& point, const Machine& machine, Move& move) {
  const Motion& motion = machine.motion;
  const Vector6 target = six(point, 0), second = six(point, 6);
  move.v = point[12] / kFixedPoint;
  move.a = point[13] / kFixedPoint;
  move.t = point[18] / kFixedPoint;
  move.r = point[19] / kFixedPoint;
  const std::int32_t type = point[20];
  switch (type) {
    case kPointMoveJ:
      move.q = target;
      return true;
    case kPointMoveJPose:
      return inverse(Frame::of(target), motion.tool(), point[14] != 0 ? second : motion.q(),
                     move.q);
    case kPointMoveL:
    case kPointMoveLJoints:
      move.kind = Move::Kind::kL;
      move.target = frame(target, type == kPointMoveLJoints, motion);
      return true;
    case kPointMoveP:
    case kPointMovePJoints:
      move.kind = Move::Kind::kP;
      move.t = 0.0;  // movep has none
      move.target = frame(target, type == kPointMovePJoints, motion);
      return true;
    case kPointMoveC:
    case kPointMoveCJoints:
    case kPointMoveCJointsPose:
    case kPointMoveCPoseJoints:
      move.kind = Move::Kind::kC;
      move.t = 0.0;
      move.fixed = point[14] != 0;
      // The names have the via point first.
      move.via = frame(second, type == kPointMoveCJoints || type == kPointMoveCJointsPose, motion);
      move.target =
          frame(target, type == kPointMoveCJoints || type == kPointMoveCPoseJoints, motion);
      return true;
    default:
      return false;
  }
}

}  // namespace tactus::ur
