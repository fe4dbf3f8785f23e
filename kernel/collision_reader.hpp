// What [collision] names: the boxes of the file become bodies, and the pairs of `allow` are looked
// up among all bodies.
#pragma once

#include "kernel/ini.hpp"
#include "kernel/pipeline.hpp"

namespace tactus {

/// Fills pipeline.collision.scene once all sections are read; nothing without [collision]. [init]
Status read_collision(const Ini& ini, Pipeline& pipeline, LoadError& error);

}  // namespace tactus
