// scene.json: the arm, the tool, the boxes and the limits of a run, for those who draw it.
#pragma once

#include "program/session/session.hpp"

namespace tactus {

/// Writes the robot's joint frames and capsules, the tool, the boxes of the pipeline file in the
/// base frame, and the limits of the joints in force. False if the file
/// cannot be written: prints the reason to stderr.
bool write_scene(const char* path, const Pipeline& pipeline);

}  // namespace tactus
