// Faults on purpose, for tests of the board; an image for use refuses to provoke any.
#pragma once

#include "hal/net/protocol_bytes.hpp"
#include "kernel/core/status.hpp"

namespace bare {

/// Does what a kProvoke asks for. kNotOffered: this image does not. [background]
tactus::Status provoke(tactus::ByteReader payload);
/// Called in every cycle: a place for a provoked one to hang. [cyclic]
void provoked_cycle();

}  // namespace bare
