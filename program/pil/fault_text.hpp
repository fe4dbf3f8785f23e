// The fault record of a board in words.
#pragma once

#include "program/pil/board_client.hpp"

namespace tactus::pil {

/// Asks for the record. [any]
Status ask_fault(BoardClient& board, serial::FaultRecord& fault);
/// Asks, and puts it into words. [any]
Message fault_text(BoardClient& board);

}  // namespace tactus::pil
