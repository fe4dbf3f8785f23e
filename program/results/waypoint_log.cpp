#include "program/results/waypoint_log.hpp"

#include "program/results/run_log.hpp"

namespace tactus {
namespace {

constexpr int kFewWaypoints = 200;

/// Returns the positions of one waypoint as an output of their quantity would hold them; a pose is
/// converted to the base frame and stored in `pose`.
PortEntry position_of(const TrajectoryInput& input, int waypoint, Pose& pose) {
  PortEntry entry;
  if (const auto* joints = std::get_if<1>(&input.trajectory)) {
    entry.quantity = Quantity::kJointPosition;
    entry.value = &(*joints)->waypoints[waypoint].point.q;
  } else if (const auto* poses = std::get_if<2>(&input.trajectory)) {
    const Pose &given = (*poses)->waypoints[waypoint].point.x, &frame = input.motion_frame;
    pose = {frame.p + frame.r * given.p, frame.r * given.r};
    entry.quantity = Quantity::kPose;
    entry.value = &pose;
  }
  return entry;
}

}  // namespace

bool write_waypoints(const char* path, const TrajectoryInput& input, const PortEntry& reference) {
  Pose pose;
  if (input.count() > kFewWaypoints || position_of(input, 0, pose).quantity != reference.quantity)
    return true;
  ResultFile result;
  if (!result.open(path)) return false;
  std::FILE* const file = result.stream();
  std::fprintf(file, "time_s");
  write_names(file, reference);
  std::fprintf(file, "\n");
  for (int i = 0; i < input.count(); ++i) {
    std::array<double, 16> numbers{};
    const int count = flatten(position_of(input, i, pose), numbers.data());
    std::fprintf(file, "%.9g", input.start_s + input.time_s(i));
    for (int n = 0; n < count; ++n)
      std::fprintf(file, ",%.9g", numbers[static_cast<std::size_t>(n)]);
    std::fprintf(file, "\n");
  }
  return result.close();
}

}  // namespace tactus
