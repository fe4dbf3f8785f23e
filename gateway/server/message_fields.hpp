// The numbers of points and waypoints, and the digital outputs, in messages. A message has pose
// quaternions as w, x, y, z, and only the fields that are given.
#pragma once

#include "gateway/chunk.hpp"
#include "gateway/reference_frames.hpp"
#include "gateway/tactus.pb.h"
#include "kernel/core/load_error.hpp"
#include "kernel/reference/motion/trajectory.hpp"
#include "kernel/reference/space/joint_space.hpp"
#include "kernel/reference/space/task_space.hpp"

namespace tactus {

/// Reads the joints that are left out, or the frames; none if they are not given. [any]
TrajectoryTerms terms_of(bool given, const tactus_Terms& from);

/// Numbers of a waypoint in a Part. [any]
template <class Space>
int numbers_in_message(Fields fields);
/// Reads so many numbers. [any]
template <class Space>
typename Space::Point point_of(const double* numbers, Fields fields);

/// Read a point of a message, and its fields. False: `why` names the field and the remedy. [any]
bool read_point(const tactus_JointPoint& from, JointSpace::Point& point, Message& why);
bool read_point(const tactus_TaskPoint& from, TaskSpace::Point& point, Message& why);

/// Write a point into a message, without fields that are not finite. [any]
void write_point(const JointSpace::Point& point, tactus_JointPoint& to);
void write_point(const TaskSpace::Point& point, tactus_TaskPoint& to);
/// Writes x, y, z, qw, qx, qy, qz. [any]
void write_pose(const Pose& pose, double* numbers);

/// kOk if all bits of `mask` are among the outputs that the pipeline commands; else kNotOffered:
/// `why` names the field, the output, what there is, and the remedy. [any]
Status judge_outputs(std::uint32_t mask, std::uint32_t offered, const char* field, Message& why);

/// Judges the channels of a chunk: each of another output that there is, with a value for each
/// target, and their lead. kNotOffered, kBadValue as above. [any]
Status judge_channels(const tactus_Chunk& from, std::uint32_t offered, Message& why);

/// Writes the channels that were judged into a chunk whose targets were read. [any]
template <class Space>
void read_channels(const tactus_Chunk& from, Chunk<Space>& chunk) {
  chunk.outputs_mask = 0;
  chunk.outputs_lead_s = from.outputs_lead_s;
  for (pb_size_t k = 0; k < from.channels_count; ++k) {
    const tactus_Channel& channel = from.channels[k];
    const std::uint32_t bit = std::uint32_t{1} << channel.output;
    chunk.outputs_mask |= bit;
    for (pb_size_t i = 0; i < channel.values_count; ++i)
      if (channel.values[i]) chunk.outputs[i] |= bit;
  }
}

}  // namespace tactus
