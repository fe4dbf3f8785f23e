// The streams that a board has, if any: chunks of targets, velocities, and the digital outputs
// beside them.
#pragma once

#include <type_traits>

namespace tactus {

inline constexpr int kChunkTargets = TACTUS_CHUNK_TARGETS;
inline constexpr bool kStreams = kChunkTargets > 0;
static_assert(kChunkTargets >= 0 && kChunkTargets <= 1 << 8, "a knot is found in 8 halvings");

/// The stamp of a point that has none.
inline constexpr double kNoStamp = -1e300;

/// Takes the place of what a board without streams does not have.
struct NoStream {};
template <class Type>
using OnlyWithStreams = std::conditional_t<kStreams, Type, NoStream>;

}  // namespace tactus
