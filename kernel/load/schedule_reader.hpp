// Reads the schedule of a pipeline, the control chain and its rows, and checks it after the last
// section has been loaded.
#pragma once

#include "kernel/load/ini.hpp"
#include "kernel/pipeline/pipeline.hpp"

namespace tactus {

/// Fills pipeline.schedule from [executive], [recorder] and every other section with a row. Refuses
/// a schedule that cannot be met, with the frame that overflows, and a stop or an arming that must
/// end before the arm can be at rest. [init]
Status read_schedule(const Ini& ini, Pipeline& pipeline, LoadError& error);

}  // namespace tactus
