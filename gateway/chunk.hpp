// Chunk: future targets of a policy or a planner, as a client sends them.
//
//   Chunk<JointSpace> chunk;            // large: keep one
//   chunk.epoch = 1;                    // newer than that of any stop
//   chunk.sequence = ++sequence;        // grows with every chunk
//   for (...) chunk.add(time_s, point); // by the generator's clock, increasing
//   client.send(chunk, id);             // answered by exactly one report with this number
//
// The clock is that of every report and every message of feedback: periods since the generator
// started.
#pragma once

#include <array>

#include "kernel/streams/chunk.hpp"

namespace tactus {

/// Origin of relative targets.
enum class ChunkBase : std::uint8_t {
  kAbsolute,   ///< nothing: they are positions
  kMeasured,   ///< where the robot was measured when the observation was made
  kCommanded,  ///< where it was commanded to be
};

inline constexpr double kUsualFade_s = 0.2;

template <class Space>
struct Chunk {
  using Point = typename Space::Point;

  std::uint32_t epoch = 1, sequence = 0;
  /// A single target of another sender continues no stream of points.
  std::uint64_t sender = 0;
  /// The last target is to be reached and held. Otherwise more chunks follow, and the curve ends
  /// with the velocity of its last targets.
  bool ends = false;
  /// Times are the sender's. If they are those of the arrival, a single target is a point that
  /// arrives with jitter.
  bool stamped = true;
  /// The targets give velocities, which the curve then has.
  bool velocities = false;
  /// Time in which a disagreement with what is in force fades, 0 to kLongestFade_s, s; longer if
  /// limits require it. 0: it is closed as fast as limits allow.
  double fade_s = kUsualFade_s;
  /// Noise in targets without velocities is smoothed away: of a sine of w rad/s the curve keeps
  /// 1 / (1 + (w smoothing_s)^4). 0: it passes through the targets.
  double smoothing_s = 0.03;
  /// Relative targets are joint angles to be added, or poses in the frame of the tip, as they were
  /// at `observed_s`, at most kHistory_s ago.
  ChunkBase base = ChunkBase::kAbsolute;
  double observed_s = 0.0;
  typename Space::Header header;  ///< joints left out, or the frame of the targets
  /// Outputs that every target gives in its bits; with a mask of 0 the chunk leaves all alone. They
  /// take effect when the motion has come within `outputs_lead_s` of the target's time, or that
  /// much later if it is negative: -kLongestLead_s to kLongestLead_s.
  std::uint32_t outputs_mask = 0;
  double outputs_lead_s = 0.0;

  int count = 0;
  std::array<double, static_cast<std::size_t>(kChunkTargets)> time_s;
  std::array<Point, static_cast<std::size_t>(kChunkTargets)> targets;
  std::array<std::uint32_t, static_cast<std::size_t>(kChunkTargets)> outputs;

  /// Appends a target; false if there is no more space.
  bool add(double at_s, const Point& target, std::uint32_t its_outputs = 0) {
    if (count >= kChunkTargets) return false;
    outputs[static_cast<std::size_t>(count)] = its_outputs;
    time_s[static_cast<std::size_t>(count)] = at_s;
    targets[static_cast<std::size_t>(count++)] = target;
    return true;
  }
};

}  // namespace tactus
