// The fault record of a board in words.
#pragma once

#include "program/pil/board_client.hpp"

namespace tactus::pil {

/// What a board keeps of its last fault.
struct BoardFault {
  std::uint8_t cause = 0;  ///< m7::FaultCause; 0: none
  std::uint32_t count = 0, cycle = 0, pc = 0, lr = 0, sp = 0, cfsr = 0, hfsr = 0, address = 0;
};

/// Asks for the record. [any]
Status ask_fault(BoardClient& board, BoardFault& fault);
/// Asks, and puts it into words. [any]
Message fault_text(BoardClient& board);

}  // namespace tactus::pil
