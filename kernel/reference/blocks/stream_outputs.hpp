// The output port of a reference generator for digital outputs.
#pragma once

#include "kernel/core/port.hpp"
#include "kernel/core/streams.hpp"

namespace tactus {

template <bool streams = kStreams>
struct StreamOutputs {
  Out<Quantity::kDigitalOutputs> outputs;  ///< of chunks and points, in time with the motion

  template <class Visitor>
  void describe_outputs(Visitor& visit) {
    visit.out("outputs", outputs);
  }
  void write_outputs(const DigitalOutputs& now) { outputs.value = now; }
};

template <>
struct StreamOutputs<false> {
  template <class Visitor>
  void describe_outputs(Visitor&) {}
  void write_outputs(const DigitalOutputs&) {}
};

}  // namespace tactus
