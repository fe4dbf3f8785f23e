// ReferenceGenerator with streams: chunks, velocities, and the digital outputs beside them.
#pragma once

#include <cstdint>

#include "kernel/reference/generator/reference_generator.hpp"
#include "kernel/streams/epoch_gate.hpp"
#include "kernel/streams/motion_streams.hpp"
#include "kernel/streams/output_delay.hpp"
#include "kernel/streams/stream_messages.hpp"

namespace tactus {

/// The account of points, chunks and velocities.
template <class Space>
struct StreamAccount {
  EpochGate gate;
  std::uint32_t id = 0;      ///< the last one that took effect
  bool expired = false;      ///< no successor arrived in time; reported
  bool saturates = false;    ///< points are beyond a range; reported
  std::uint64_t sender = 0;  ///< of the last point
  /// Time in which a point still counts as a successor of one that was refused for its step.
  double step_s = 0.0;
  bool approaches = false;  ///< the reference is on its way to such a successor
  /// Kept as they are by every stop. A start commands none, so that none that people have changed
  /// in the meantime changes back.
  OutputDelay outputs;
};

}  // namespace tactus
