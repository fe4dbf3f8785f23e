// Additions of streams to the messages between a client and a reference generator.
#pragma once

#include <cstdint>

#include "kernel/core/digital_outputs.hpp"
#include "kernel/core/streams.hpp"
#include "kernel/reference/generator/messages.hpp"
#include "kernel/streams/chunk.hpp"
#include "kernel/streams/velocity.hpp"

namespace tactus {

/// Details of a point on a board with streams.
struct PointDetails {
  DigitalOutputs outputs;     ///< set when it takes effect
  double stamp_s = kNoStamp;  ///< when it was made, s, by a clock of its sender
  std::uint64_t sender = 0;   ///< a point of another one continues no stream
};

/// Further parts of a request on a board with streams.
template <class Space>
struct StreamRequest {
  Velocity<Space> velocity;  ///< kVelocity
  PointDetails details;      ///< kPoint
};

}  // namespace tactus
