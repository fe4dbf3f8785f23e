// The digital outputs in [robot], on a board with streams.
#pragma once

#include "kernel/core/hal.hpp"
#include "kernel/core/port.hpp"

namespace tactus {

template <bool streams = kStreams>
struct OutputsSection {
  In<Quantity::kDigitalOutputs> outputs;
  std::uint32_t offered = 0;  ///< bit i: output i can be commanded; set by the loader

  template <class Visitor>
  void describe_outputs(Visitor& visit) {
    visit.optional("outputs", outputs);
  }
  bool commands_outputs() const { return outputs.wired(); }
  /// Names the outputs of the robot, once the input is bound. [init]
  void offer_outputs(std::uint32_t of_robot) { offered = commands_outputs() ? of_robot : 0; }
  /// Adds the digital outputs to a command, whatever it requests of the drives. [cyclic]
  void write_outputs(RobotCommand& command) const { command.outputs = *outputs; }
};

template <>
struct OutputsSection<false> {
  template <class Visitor>
  void describe_outputs(Visitor&) {}
  bool commands_outputs() const { return false; }
  void offer_outputs(std::uint32_t) {}
  void write_outputs(RobotCommand&) const {}
};

}  // namespace tactus
