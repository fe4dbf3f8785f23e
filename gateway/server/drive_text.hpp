// Texts of the drive events in the event log, for operators and clients.
#pragma once

#include "kernel/core/hal.hpp"
#include "kernel/cycle/event_log.hpp"

namespace tactus {

/// ", error code 7305h, encoder 1", or what the robot calls a drive's code; empty for none. [any]
Message describe_code(const Hal& hal, std::uint32_t code);
/// "joint 3 stood in fault, which arming clears: drive or safety fault (97), error code ...", and
/// of a warning and of a drive that stops the arm; empty for any other event. [any]
Message describe_drive(const Hal& hal, const Event& event);

}  // namespace tactus
