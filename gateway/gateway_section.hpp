// The [gateway] section of a pipeline file: how references reach the pipeline.
#pragma once

#include "kernel/describe.hpp"
#include "kernel/load_error.hpp"
#include "kernel/reference/joint_space.hpp"

namespace tactus {

inline constexpr std::array<const char*, 5> kInterpolationWords = {"by_fields", "linear", "cubic",
                                                                   "quintic", "monotone"};

/// What is done with a trajectory file that gives only some of the joints.
enum class PartialJoints : std::uint8_t { kRefuse, kHold };
inline constexpr std::array<const char*, 2> kPartialJointsWords = {"refuse", "hold"};

/// What is done with a trajectory that is beyond a limit in its own times.
enum class Times : std::uint8_t { kStretched, kExact };
inline constexpr std::array<const char*, 2> kTimesWords = {"stretched", "exact"};

struct GatewaySection {
  Value trajectory;  ///< default trajectory file, relative to the pipeline file
  Interpolation interpolation = Interpolation::kByFields;
  Times times = Times::kStretched;
  double start_s = 0.0;  ///< when the trajectory begins, by the generator's clock; 0: at once
  PartialJoints partial_joints = PartialJoints::kRefuse;
  Value motion_frame;     ///< a pose of the pipeline, "block.port"; none: the base
  Value wrench_frame;     ///< likewise; none: the axes of the base, about the tip
  double settle_s = 2.0;  ///< how long a run goes on after its trajectory has ended

  template <class Visitor>
  void describe(Visitor& visit) {
    visit.text("trajectory", trajectory, "default trajectory file");
    visit.choice("interpolation", interpolation, kInterpolationWords);
    visit.choice("times", times, kTimesWords);
    visit.param("start_s", start_s, Range{0.0, 3600.0}, "s");
    visit.choice("partial_joints", partial_joints, kPartialJointsWords);
    visit.text("motion_frame", motion_frame, "the pose in whose frame the trajectory is given");
    visit.text("wrench_frame", wrench_frame, "the pose in whose frame its wrench is given");
    visit.param("settle_s", settle_s, Range{0.0, 3600.0}, "s");
  }
};

}  // namespace tactus
