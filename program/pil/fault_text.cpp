#include "program/pil/fault_text.hpp"

#include <cstdio>

namespace tactus::pil {

Status ask_fault(BoardClient& board, serial::FaultRecord& fault) {
  TRY(board.request(serial::Kind::kFault));
  ByteReader from = board.answer();
  return read(from, fault) ? Status::kOk : Status::kWireFormat;
}

Message fault_text(BoardClient& board) {
  serial::FaultRecord fault;
  if (ask_fault(board, fault) != Status::kOk)
    return Message("the board keeps no fault that this program knows");
  char numbers[160];
  std::snprintf(
      numbers, sizeof numbers,
      " in cycle %u: pc %08x, lr %08x, sp %08x, CFSR %08x, HFSR %08x, address %08x; %u since"
      " it was switched on",
      fault.cycle, fault.pc, fault.lr, fault.sp, fault.cfsr, fault.hfsr, fault.address,
      fault.count);
  Message text("the board has started again after ");
  return text << name(fault.cause) << numbers;
}

}  // namespace tactus::pil
