// A chunk in the form that the cycle follows: a C2 curve of quintics through knots, fitted outside
// the cycle from the targets that a client sent (gateway/chunk_fit.hpp).
//
// The client takes a free store, writes the curve and sends its number. The store is the plan's
// until it is released, so that a chunk is installed in one cycle, without a copy.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "kernel/core/published.hpp"
#include "kernel/core/streams.hpp"
#include "kernel/core/verdict.hpp"
#include "kernel/reference/space/interpolation.hpp"

namespace tactus {

/// Chunks that can be in force, wait for their first stamp and be on their way, together.
inline constexpr std::size_t kChunkStores = kStreams ? 8 : 0;

/// Longest crossfade, s.
inline constexpr double kLongestFade_s = 0.3;
/// Longest time from one target of a chunk to another, and to the first one from now, s.
inline constexpr double kLongestChunk_s = 600.0;
/// Longest time by which digital outputs come before or after their targets, s.
inline constexpr double kLongestLead_s = 0.5;

template <class Space>
struct Knot {
  double time_s = 0.0;  ///< by the generator's clock
  typename Space::Point point;
};

template <class Space>
struct ChunkCurve {
  std::array<Knot<Space>, static_cast<std::size_t>(kChunkTargets)> knots;
  int count = 0;        ///< one: a target of teleoperation, a point of a stream
  bool stamped = true;  ///< its time is the sender's; else it is that of its arrival
  bool ends = false;    ///< at rest at the last knot; else more chunks are to follow
  std::uint32_t epoch = 0, sequence = 0;
  std::uint64_t sender = 0;       ///< of a single target, as that of a point
  typename Space::Header header;  ///< joints left out, or frames the knots are given in
  /// Time in which a disagreement fades; longer if limits require it. 0: closed as fast as limits
  /// allow.
  double fade_s = 0.0;
  /// If no chunk follows, path time begins to stop at brake_s, by the generator's clock, with these
  /// limits of its second and third derivative, and rests at the last knot. From full rate it takes
  /// brake_way_s of path time.
  double brake_s = 0.0, brake_way_s = 1.0, brake_a = 1.0, brake_j = 1.0;
  /// Digital outputs from each target's stamp on, less the lead; with a mask of 0 none.
  std::array<std::uint32_t, static_cast<std::size_t>(kChunkTargets)> outputs;
  std::uint32_t outputs_mask = 0;
  double outputs_lead_s = 0.0;
  Verdict saturation;  ///< kSaturated for the first target held at the end of a range, or kOk
  std::atomic<bool> free{true};

  double first_s() const { return knots[0].time_s; }
  double end_s() const { return knots[static_cast<std::size_t>(count - 1)].time_s; }
  /// Gives the store back to the client. [cyclic]
  void release() { free.store(true, std::memory_order_release); }
};

/// Counters and margins of the chunks and velocities of one generator since its first start; a
/// client may read them at any time.
struct StreamState {
  Published<std::uint32_t> trimmed;  ///< targets whose time had passed when their chunk came
  Published<std::uint32_t> late;     ///< chunks of which nothing was left
  Published<std::uint32_t> dropped;  ///< chunks and velocities: duplicate, older, or void
  Published<std::uint32_t> starved;  ///< stops because no successor arrived
  Published<std::uint32_t> shaped;   ///< cycles in which limits kept the reference off its curve
  Published<std::uint32_t> epoch;    ///< the least that is not void
  Published<float> seam;             ///< largest component of the last disagreement, rad or m
  Published<float> offset;    ///< largest component of what limits keep off the curve, rad or m
  Published<float> margin_s;  ///< time until the stop begins if no successor arrives; 0: none runs
};

/// The chunk stores of a channel, and their counters.
template <class Space>
struct ChunkStores {
  std::array<ChunkCurve<Space>, kChunkStores> chunks;
  StreamState stream;
};

}  // namespace tactus
