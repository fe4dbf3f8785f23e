// The chunks of a policy as scripts/policies writes them: one row per point, chunks in the order of
// their arrival.
//
//   t_obs_ns,t_arrival_ns,chunk_id,step,t_target_ns,<position>,gripper
//
// All times are those of the robot's clock. A position is that of the joints in rad, or of the tip
// in m and as a quaternion, w first.
#pragma once

#include <cstdint>
#include <vector>

namespace tactus {

struct ChunkPoint {
  std::int64_t t_target_ns = 0;
  std::vector<double> position;
  double gripper = 0.0;
};

struct ChunkMessage {
  std::int64_t t_obs_ns = 0, t_arrival_ns = 0;
  std::uint32_t number = 0;
  std::vector<ChunkPoint> points;
};

/// Reads the chunks of a file with `positions` numbers per position. False: it cannot be read, or a
/// row is none; the error stream says where.
bool read_chunks(const char* path, int positions, std::vector<ChunkMessage>& chunks);

}  // namespace tactus
