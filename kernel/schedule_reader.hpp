// The schedule of a pipeline: the control chain and the rows it has, judged after the last section
// has been loaded.
#pragma once

#include "kernel/ini.hpp"
#include "kernel/pipeline.hpp"

namespace tactus {

/// Fills pipeline.schedule from [executive], [recorder] and whatever else has a row. A schedule
/// that cannot be met is refused, with the frame that overflows. [init]
Status read_schedule(const Ini& ini, Pipeline& pipeline, LoadError& error);

}  // namespace tactus
