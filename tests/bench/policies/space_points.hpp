// The points of a chunk file as references of a space, at rest.
#pragma once

#include <algorithm>

#include "kernel/reference/space/joint_space.hpp"
#include "kernel/reference/space/task_space.hpp"
#include "tests/bench/policies/chunk_file.hpp"

namespace tactus {

template <class Space>
typename Space::Point point_of(const ChunkPoint& given);

template <>
inline JointSpace::Point point_of<JointSpace>(const ChunkPoint& given) {
  JointSpace::Point point;
  std::copy(given.position.begin(), given.position.end(), point.q.data());
  return point;
}

template <>
inline TaskSpace::Point point_of<TaskSpace>(const ChunkPoint& given) {
  const std::vector<double>& x = given.position;
  TaskSpace::Point point;
  point.x = {{x[0], x[1], x[2]}, Eigen::Quaterniond(x[3], x[4], x[5], x[6])};
  return point;
}

}  // namespace tactus
