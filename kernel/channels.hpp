// Channels: the ways into the reference generators that a board offers to a pipeline, at most one
// for each space.
#pragma once

#include "kernel/reference/joint_space.hpp"
#include "kernel/reference/messages.hpp"
#include "kernel/reference/task_space.hpp"

namespace tactus {

struct Channels {
  ReferenceChannel<JointSpace>* joint = nullptr;
  ReferenceChannel<TaskSpace>* task = nullptr;
};

}  // namespace tactus
