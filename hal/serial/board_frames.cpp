#include "hal/serial/board_frames.hpp"

namespace tactus::serial {

void write(ByteWriter& to, const FaultRecord& record) {
  to.u8(static_cast<std::uint8_t>(record.cause));
  for (const std::uint32_t number : {record.count, record.cycle, record.pc, record.lr, record.sp,
                                     record.cfsr, record.hfsr, record.address})
    to.u32(number);
}

bool read(ByteReader& from, FaultRecord& record) {
  record.cause = static_cast<FaultCause>(from.u8());
  for (std::uint32_t* const number : {&record.count, &record.cycle, &record.pc, &record.lr,
                                      &record.sp, &record.cfsr, &record.hfsr, &record.address})
    *number = from.u32();
  return from.done() && name(record.cause) != nullptr;
}

void write(ByteWriter& to, const Greeting& greeting) {
  to.u8(greeting.version);
  to.u8(greeting.joints);
  to.short_text(greeting.robot);
  to.u64(greeting.text);
  to.u8(static_cast<std::uint8_t>(greeting.fault));
}

bool read(ByteReader& from, Greeting& greeting) {
  greeting.version = from.u8();
  greeting.joints = from.u8();
  greeting.robot = Text<31>(from.text(from.u8()));
  greeting.text = from.u64();
  greeting.fault = static_cast<FaultCause>(from.u8());
  return from.done() && name(greeting.fault) != nullptr;
}

}  // namespace tactus::serial
