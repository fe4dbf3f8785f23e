// Channels: the reference channels that a board offers to the reference generators of a pipeline,
// at most one for each space.
#pragma once

#include "kernel/reference/space/joint_space.hpp"
#include "kernel/reference/space/task_space.hpp"
#include "kernel/streams/stream_messages.hpp"

namespace tactus {

struct Channels {
  ReferenceChannel<JointSpace>* joint = nullptr;
  ReferenceChannel<TaskSpace>* task = nullptr;
};

}  // namespace tactus
