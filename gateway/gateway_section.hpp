// GatewaySection: the [gateway] section of a pipeline file, which says how references reach the
// pipeline.
#pragma once

#include "gateway/joint_turns.hpp"
#include "kernel/core/describe.hpp"
#include "kernel/core/load_error.hpp"
#include "kernel/reference/space/joint_space.hpp"

namespace tactus {

/// Treatment of a trajectory file that gives only some of the joints.
enum class PartialJoints : std::uint8_t { kRefuse, kHold };

constexpr const char* name(PartialJoints rule) {
  switch (rule) {
    case PartialJoints::kRefuse: return "refuse";
    case PartialJoints::kHold: return "hold";
  }
  return nullptr;
}

/// Treatment of a trajectory that exceeds a limit in its own times.
enum class Times : std::uint8_t { kStretched, kExact };

constexpr const char* name(Times times) {
  switch (times) {
    case Times::kStretched: return "stretched";
    case Times::kExact: return "exact";
  }
  return nullptr;
}

struct GatewaySection {
  Value trajectory;  ///< default trajectory file, relative to the pipeline file
  Interpolation interpolation = Interpolation::kByFields;
  Times times = Times::kStretched;
  double start_s = 0.0;  ///< when the trajectory begins, by the generator's clock; 0: at once
  PartialJoints partial_joints = PartialJoints::kRefuse;
  Wrap wrap = Wrap::kAsGiven;  ///< of the trajectory; clients say their own
  Value motion_frame;          ///< a pose of the pipeline, "block.port"; none: the base
  Value wrench_frame;  ///< a pose of the pipeline; none: the axes of the base, about the tip
  /// Time for which a run continues after its trajectory has ended; longer if its goal is still
  /// awaited, up to the generator's goal_time_s.
  double settle_s = 2.0;
  /// By how much the positions of a file may be moved to smooth it, in addition to half of the last
  /// digit; 0: not at all.
  double smoothing_rad = 0.005, smoothing_m = 0.001;

  template <class Visitor>
  void describe(Visitor& visit) {
    visit.text("trajectory", trajectory, "default trajectory file");
    visit.choice("interpolation", interpolation);
    visit.choice("times", times);
    visit.param("start_s", start_s, Range{0.0, 3600.0}, "s");
    visit.choice("partial_joints", partial_joints);
    visit.choice("wrap", wrap);
    visit.text("motion_frame", motion_frame, "the pose in whose frame the trajectory is given");
    visit.text("wrench_frame", wrench_frame, "the pose in whose frame its wrench is given");
    visit.param("settle_s", settle_s, Range{0.0, 3600.0}, "s");
    visit.param("smoothing_rad", smoothing_rad, Range{0.0, 0.1}, "rad");
    visit.param("smoothing_m", smoothing_m, Range{0.0, 0.1}, "m");
  }
};

}  // namespace tactus
