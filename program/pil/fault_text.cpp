#include "program/pil/fault_text.hpp"

#include <array>
#include <cstdio>

namespace tactus::pil {
namespace {

constexpr std::array<const char*, 6> kCauses = {"none",
                                                "a fault of the core",
                                                "a full stack",
                                                "a cycle that did not end, by the watchdog",
                                                "background work that did not end",
                                                "the program gave up"};

}  // namespace

Status ask_fault(BoardClient& board, BoardFault& fault) {
  TRY(board.request(serial::Kind::kFault));
  ByteReader from = board.answer();
  fault.cause = from.u8();
  for (std::uint32_t* number : {&fault.count, &fault.cycle, &fault.pc, &fault.lr, &fault.sp,
                                &fault.cfsr, &fault.hfsr, &fault.address})
    *number = from.u32();
  return from.done() ? Status::kOk : Status::kWireFormat;
}

Message fault_text(BoardClient& board) {
  BoardFault fault;
  if (ask_fault(board, fault) != Status::kOk || fault.cause >= kCauses.size())
    return Message("the board keeps no fault that this program knows");
  char numbers[160];
  std::snprintf(
      numbers, sizeof numbers,
      " in cycle %u: pc %08x, lr %08x, sp %08x, CFSR %08x, HFSR %08x, address %08x; %u since"
      " it was switched on",
      fault.cycle, fault.pc, fault.lr, fault.sp, fault.cfsr, fault.hfsr, fault.address,
      fault.count);
  Message text("the board has started again after ");
  return text << kCauses[fault.cause] << numbers;
}

}  // namespace tactus::pil
