// Reads the names of [collision]: the boxes of the file become bodies, and the pairs of `allow` are
// looked up among all bodies.
#pragma once

#include "kernel/load/ini.hpp"
#include "kernel/pipeline/pipeline.hpp"

namespace tactus {

/// Fills pipeline.collision.scene after all sections are read; does nothing without [collision].
/// [init]
Status read_collision(const Ini& ini, Pipeline& pipeline, LoadError& error);

}  // namespace tactus
