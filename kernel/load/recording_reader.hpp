// Reads the lists of outputs in [recorder], after the last block has been loaded.
#pragma once

#include "kernel/load/ini.hpp"
#include "kernel/pipeline/pipeline.hpp"

namespace tactus {

/// Fills pipeline.recording from pipeline.recorder. Refuses outputs that are unknown or cannot be
/// recorded, and pairs of unlike quantities. [init]
Status read_recording(const Ini& ini, Pipeline& pipeline, LoadError& error);

}  // namespace tactus
