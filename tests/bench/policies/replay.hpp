// Replays the chunks of a policy in lock-step: a cycle takes what has arrived before it.
#pragma once

#include <cstdint>
#include <vector>

#include "tests/bench/policies/chunk_file.hpp"

namespace tactus {

struct Replay {
  std::int64_t period_us = 1000;
  double duration_s = 0.0;
  const char* out = nullptr;  ///< the file for what is commanded, see recording.hpp
  double fade_s = 0.2;        ///< of chunks, see gateway/chunk.hpp
  double smoothing_s = 0.0;

  double period_s() const { return 1e-6 * static_cast<double>(period_us); }
  int cycles() const { return static_cast<int>(duration_s / period_s() + 0.5); }
  std::int64_t time_ns(int cycle) const { return 1000 * period_us * cycle; }
  double time_s(int cycle) const { return 1e-9 * static_cast<double>(time_ns(cycle)); }
};

// All begin at rest at the first point of the first chunk, and return false if the file cannot be
// written or the generator fails.

/// Moves to every target that is due as if it were the last.
bool replay_rest(const std::vector<ChunkMessage>& chunks, const Replay& replay);
/// Sends every target that is due as a point.
bool replay_stream(const std::vector<ChunkMessage>& chunks, const Replay& replay);
/// Sends every chunk when it arrives, and prints what became of them.
template <class Space>
bool replay_chunks(const std::vector<ChunkMessage>& messages, const Replay& replay);

}  // namespace tactus
