// Motion with streams: along the curves of chunks, and at a given velocity.
#pragma once

#include "kernel/reference/motion/motion.hpp"
#include "kernel/streams/approach.hpp"
#include "kernel/streams/chunk_plan.hpp"
#include "kernel/streams/velocity.hpp"

namespace tactus {

/// The additional state of a motion on a board with streams.
template <class Space>
struct MotionStreams {
  ChunkPlan<Space> plan;  // the base while chunks are followed
  Velocity<Space> velocity;
  double velocity_until_s = 0.0;
  Approach<Space> approach;
};

}  // namespace tactus
