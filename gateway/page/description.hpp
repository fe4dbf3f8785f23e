// The description of robot and pipeline for the page, as JSON, once: geometry for the picture of
// the arm, limits, and the blocks with their wires.
#pragma once

#include <string_view>

#include "gateway/page/json.hpp"
#include "kernel/pipeline/pipeline.hpp"

namespace tactus {

struct PageSubject {
  std::string_view board, file;  ///< the file: name of the pipeline
  Pipeline& pipeline;            ///< loaded; no cycle has begun
  bool simulated;                ///< the robot is a plant in this program
};

/// Writes joints, frames and capsules, and the boxes whose place is known before the first cycle.
/// [init]
void describe_robot(Pipeline& pipeline, Json& to);

/// Writes "blocks": of each its name, its type, its inputs, with the number of the output that each
/// is connected to (-1: of none), and its outputs, numbered as in the port table. "robot" has the
/// measured values, "command" the inputs of the robot. [init]
void describe_blocks(Pipeline& pipeline, Json& to);

/// Writes the whole description. [init]
void describe_page(const PageSubject& subject, std::string_view token, Json& to);

}  // namespace tactus
