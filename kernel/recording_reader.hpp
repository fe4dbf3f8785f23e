// The [recorder] section's lists of outputs, resolved after the last block has been loaded.
#pragma once

#include "kernel/ini.hpp"
#include "kernel/pipeline.hpp"

namespace tactus {

/// Fills pipeline.recording from pipeline.recorder. Unknown, unrecordable or unequal outputs are
/// refused. [init]
Status read_recording(const Ini& ini, Pipeline& pipeline, LoadError& error);

}  // namespace tactus
