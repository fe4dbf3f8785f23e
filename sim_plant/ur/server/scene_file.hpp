// Reads the surroundings of the arm from a pipeline file on disk.
#pragma once

#include "sim_plant/ur/motion/surroundings.hpp"

namespace tactus::ur {

/// Fills `around` from the pipeline file at `path`. False: refused; prints "path:line: [section]
/// key: reason" to stderr. [init]
bool read_scene_file(const char* path, Surroundings& around);

}  // namespace tactus::ur
