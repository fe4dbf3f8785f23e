// The protocols between a Universal Robots controller (CB3, software 3.x) and its clients, defined
// once for both ends.
#pragma once

#include "hal/net/protocol_bytes.hpp"
#include "hal/ur/protocol_frames.hpp"
#include "hal/ur/protocol_modes.hpp"
#include "hal/ur/protocol_rtde.hpp"
#include "hal/ur/protocol_script.hpp"
#include "hal/ur/protocol_state.hpp"
