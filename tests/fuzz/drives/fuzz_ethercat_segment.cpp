// Fuzzes the emulated segment with frames. Every frame comes back with its length, registers and
// drives stay within what they can be, and nothing hangs.
//
// The tape is a row of datagrams: command, time, address, length, then the data.
#include "sim_plant/ethercat/segment.hpp"
#include "tests/fuzz/fuzzing.hpp"

namespace {

using namespace tactus;
using namespace tactus::ethercat;

constexpr std::int64_t kMillisecond_ns = 1'000'000;
constexpr std::uint8_t kSource[6] = {0x02, 0, 0, 0, 0, 1};

/// Mostly registers and mailboxes that mean something, of the first slave.
std::uint32_t address(std::uint8_t choice, std::uint8_t low) {
  constexpr std::uint16_t kRegs[] = {0x0010, 0x0120, 0x0130, 0x0500, 0x0502, 0x0600,
                                     0x0610, 0x0800, 0x0808, 0x0810, 0x0818, 0x0900,
                                     0x0910, 0x0920, 0x1000, 0x1100};
  const auto reg = static_cast<std::uint16_t>(kRegs[choice & 15] + (choice >= 0x80 ? low : 0));
  return address_of((choice & 0x40) != 0 ? 0x1001 : 0, reg);
}

void check_drive(segment::DriveSlave& slave) {
  const auto state = slave.axis().state();
  const bool moves = state == cia402::State::kOperationEnabled ||
                     state == cia402::State::kQuickStopActive ||
                     state == cia402::State::kFaultReactionActive;
  MUST(slave.axis().powered() == moves);
  MUST(moves || slave.axis().braked());
  MUST((slave.esc().status() & kAlStateBits) == static_cast<std::uint16_t>(slave.state()));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static segment::Segment line;
  segment::SegmentSettings settings;
  settings.slaves = 2;
  std::int64_t now_ns = kMillisecond_ns;
  MUST(line.load(settings, now_ns) == Status::kOk);
  for (std::size_t at = 0; at + 5 <= size;) {
    Frame frame;
    FrameWriter writer(frame, kSource);
    const std::uint8_t command = data[at], time = data[at + 1];
    const std::size_t wanted = data[at + 4];
    const std::uint32_t where = address(data[at + 2], data[at + 3]);
    at += 5;
    std::uint8_t* const bytes = writer.add(static_cast<Command>(command & 0x0F), 1, where, wanted);
    for (std::size_t i = 0; i < wanted && at < size; ++i) bytes[i] = data[at++];
    if ((command & 0x80) != 0 && at < size) frame.bytes[12 + time % (frame.size - 12)] = data[at++];
    now_ns += (time & 0x80) != 0 ? (time & 0x7F) * kMillisecond_ns : 1000;
    line.receive(frame, now_ns);
    line.advance(now_ns);
    Frame back;
    while (line.take(back)) MUST(back.size == frame.size);
    for (int i = 0; i < settings.slaves; ++i) check_drive(line.slave(i));
  }
  return 0;
}
