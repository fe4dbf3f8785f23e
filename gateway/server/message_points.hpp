// The numbers of points and waypoints in messages, as points of their space. A message has pose
// quaternions as w, x, y, z, and only the fields that are given.
#pragma once

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

}  // namespace tactus
