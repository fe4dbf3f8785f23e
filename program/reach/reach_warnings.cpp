#include "program/reach/reach_warnings.hpp"

#include <algorithm>
#include <cstdio>

#include "program/reach/path_check.hpp"

namespace tactus {
namespace {

constexpr int kMostSamples = 20000;
constexpr int kMostLines = 12;

using Words = Text<511>;

template <class... Numbers>
void add(Words& text, const char* format, Numbers... numbers) {
  char line[256];
  std::snprintf(line, sizeof line, format, numbers...);
  text << line;
}

void add_joint(Words& text, int joint) {
  text << "joint " << joint + 1 << " (" << Robot::kJointNames[static_cast<std::size_t>(joint)]
       << ")";
}

void add_place(Words& text, const Finding& found) {
  add(text, "at t = %.6g s, (%.4g, %.4g, %.4g) m, ", found.worst_s, found.place.x(),
      found.place.y(), found.place.z());
}

/// The pose in which the tip stays, and the joint that holds it back.
void add_distance(Words& text, const Finding& found) {
  add_place(text, found);
  add(text, "it stays %.3g m and %.3g rad away", found.value, found.angle_rad);
  if (found.joint < 0) return;
  text << " with ";
  add_joint(text, found.joint);
  text << " at its limit";
}

Words words_of(const Finding& found) {
  Words text;
  add(text, found.from_s < found.to_s ? "t = %.6g to %.6g s: " : "t = %.6g s: ", found.from_s,
      found.to_s);
  switch (found.kind) {
    case Finding::kOutOfReach:
      text << "out of reach: ";
      add_distance(text, found);
      return text << "; move the path or the base of the arm";
    case Finding::kOtherPosture:
      text << "in reach, but not on this path: ";
      add_distance(text, found);
      return text << "; start in another posture, or approach it another way";
    case Finding::kSingular:
      text << "near a singularity: ";
      add_place(text, found);
      add(text, "sigma is %.3g, and below %.3g the tip may leave the path", found.value,
          found.limit);
      return text << "; move or turn the path";
    case Finding::kFastJoint:
      text << "too fast for the arm: ";
      add_place(text, found);
      add_joint(text, found.joint);
      add(text, " %s at %.4g %s/s, its limit is %.4g",
          is_prismatic<Robot>(found.joint) ? "moves" : "turns", found.value,
          position_unit(found.joint), found.limit);
      return text << "; give the path more time, or lead it past the singularity";
    case Finding::kNearLimit:
      text << "near a joint limit: ";
      add_place(text, found);
      add_joint(text, found.joint);
      add(text, " is at %.5g %s, its limit is %.5g", found.value, position_unit(found.joint),
          found.limit);
      return text << "; start in another posture, or move the path";
  }
  return text;
}

/// A trajectory of poses, read in rising times.
class PoseReader {
 public:
  PoseReader(const Trajectory<TaskSpace>& trajectory, const Pose& frame) : trajectory_(trajectory) {
    placement_.motion = frame;
    placement_.moved = trajectory.header.motion != nullptr;
  }
  Pose at(double time_s) {
    if (trajectory_.count == 1) return trajectory_.point(0, placement_).x;
    int target = std::max(target_, 1);
    while (target < trajectory_.count - 1 && trajectory_.time_s(target) < time_s) ++target;
    if (target != target_) segment_ = trajectory_.segment(target, placement_);
    target_ = target;
    return segment_.at(time_s - trajectory_.time_s(target - 1)).x;
  }

 private:
  const Trajectory<TaskSpace>& trajectory_;
  TaskSpace::Placement placement_;
  TaskSpace::Segment segment_;
  int target_ = 0;  // waypoint at which the segment ends; 0: none yet
};

void walk(const Trajectory<TaskSpace>& trajectory, const Pose& frame, double period_s,
          PathCheck& check) {
  PoseReader path(trajectory, frame);
  const double begin_s = trajectory.time_s(0), length_s = trajectory.end_s() - begin_s;
  const int samples = std::clamp(static_cast<int>(length_s / period_s), 1, kMostSamples);
  check.approach(path.at(begin_s));
  for (int k = 0; k <= (length_s > 0.0 ? samples : 0); ++k) {
    const double time_s = begin_s + length_s * k / samples;
    check.go_on(time_s, path.at(time_s));
  }
}

}  // namespace

bool judge_reach(const Session& session, const TrajectoryInput& input, const JointVector& q) {
  const auto* const poses = std::get_if<2>(&input.trajectory);
  if (poses == nullptr) return true;
  const Pipeline& pipeline = session.pipeline;
  const InverseKinematics arm(pipeline.guard.references(), pipeline.robot.tool.value.tip);
  PathCheck check(arm, q);
  walk(**poses, input.motion_frame, pipeline.robot.period_s(), check);
  if (input.longer())
    std::fprintf(stderr, "%s: note: the reach is judged for its first %d waypoints only\n",
                 input.path.c_str(), (*poses)->count);
  const int shown = std::min(check.count(), kMostLines);
  for (int i = 0; i < shown; ++i)
    std::fprintf(stderr, "%s: %s: %s\n", input.path.c_str(),
                 check[i].kind == Finding::kOutOfReach ? "refused" : "warning",
                 words_of(check[i]).c_str());
  const int more = check.count() - shown + check.left_out();
  const char* const kind = check.out_of_reach() ? "refused" : "warning";
  if (more > 0) std::fprintf(stderr, "%s: %s: and %d more\n", input.path.c_str(), kind, more);
  return !check.out_of_reach();
}

}  // namespace tactus
