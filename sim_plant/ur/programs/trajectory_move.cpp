#include "sim_plant/ur/programs/trajectory_move.hpp"

#include "sim_plant/ur/script/script_text.hpp"

namespace tactus::ur {
namespace {

/// Returns a pose that is given directly or by joint positions.
Frame frame(const Vector6& values, bool joints, const Motion& motion) {
  return joints ? forward(values) * motion.tool() : Frame::of(values);
}

/// Finds the place of the integer that the text assigns to `variable`. A list of URScript that was
/// read from a socket begins with a count, so its elements are one place later.
void find_place(std::string_view text, std::string_view variable, std::size_t& place) {
  double element = 0.0;
  if (!number_after(text, variable, element)) return;
  if (element >= 1.0 && element <= static_cast<double>(kTrajectoryInts))
    place = static_cast<std::size_t>(element) - 1;
}

PointFormat::Places find_places(std::string_view text, PointFormat::Places places) {
  find_place(text, "velocity = raw_point[", places.v);
  find_place(text, "acceleration = raw_point[", places.a);
  return places;
}

void find_scale(std::string_view text, std::string_view variable, double& scale) {
  double value = 0.0;
  if (number_after(text, variable, value) && value >= 1.0) scale = value;
}

}  // namespace

Vector6 six_numbers(const TrajectoryPoint& point, std::size_t first, double scale) {
  Vector6 values;
  for (int i = 0; i < 6; ++i) values[i] = point[first + static_cast<std::size_t>(i)] / scale;
  return values;
}

PointFormat find_point_format(std::string_view text) {
  PointFormat format;
  format.moves = format.circles = find_places(text, format.moves);
  const std::size_t circle = text.find("== MOTION_TYPE_MOVEC");
  if (circle != std::string_view::npos)
    format.circles = find_places(text.substr(circle), format.moves);
  find_scale(text, "MULT_time = ", format.time_scale);
  find_scale(text, "MULT_velacc = ", format.rate_scale);
  return format;
}

bool is_optimove(std::int32_t type) {
  return type == kPointOptimoveJ || type == kPointOptimoveL || type == kPointOptimoveJPose ||
         type == kPointOptimoveLJoints;
}

bool is_move(std::int32_t type) {
  return (type >= kPointMoveJ && type <= kPointMoveC) ||
         (type >= kPointMoveJPose && type <= kPointMoveCPoseJoints);
}

bool read_move(const TrajectoryPoint& point, const PointFormat& format, const Machine& machine,
               Move& move) {
  const Motion& motion = machine.motion;
  const Vector6 target = six_numbers(point, 0), second = six_numbers(point, 6);
  const auto set_speed = [&](const PointFormat::Places& places) {
    move.v = point[places.v] / kFixedPoint;
    move.a = point[places.a] / kFixedPoint;
  };
  set_speed(format.moves);
  move.t = point[18] / format.time_scale;
  move.r = point[19] / format.time_scale;
  const std::int32_t type = point[20];
  switch (type) {
    case kPointMoveJ: move.q = target; return true;
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
      set_speed(format.circles);
      move.t = 0.0;
      move.fixed = point[14] != 0;
      // The names give the type of the end first.
      move.via = frame(second, type == kPointMoveCJoints || type == kPointMoveCPoseJoints, motion);
      move.target =
          frame(target, type == kPointMoveCJoints || type == kPointMoveCJointsPose, motion);
      return true;
    default: return false;
  }
}

}  // namespace tactus::ur
