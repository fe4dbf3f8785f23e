// Fuzzes the master of the drives while it follows: whatever frames come, it commands torques and
// enables drives only while they are armed.
#include <memory>

#include "tests/fuzz/fuzzing.hpp"
#include "tests/wcet/can/can_bench.hpp"

namespace {

using namespace tactus;
using namespace tactus::can;

void check(CanBench& bench) {
  const Outbox& out = bench.master.outbox(0);
  const cia402::ArmingPhase phase = bench.master.phase();
  const bool up =
      phase >= cia402::ArmingPhase::kSwitchingOn && phase <= cia402::ArmingPhase::kArmed;
  MUST(bench.state.q.allFinite() && bench.state.dq.allFinite() && bench.state.tau.allFinite());
  for (int i = 0; i < out.count(); ++i) {
    const CanFrame& frame = out.frames()[i];
    if (frame.id != kRpdoBase[0] + 1) continue;
    for (std::size_t at = 0; at < 4 * kDof; at += 4) {
      const bool enables = (load<std::uint16_t>(frame.data, at) & 0x0008) != 0;
      MUST(up || (!enables && load<std::int16_t>(frame.data, at + 2) == 0));
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bench = std::make_unique<CanBench>();
  bench->drive.brake_ms = 20;
  MUST(bench->load(true) && bench->connect());
  for (int i = 0; i < 60 + bench->drive.held_ms(); ++i) bench->quiet_cycle(DriveRequest::kArm);
  bench->command.value.setConstant(1.0);
  bench->quiet_cycle(DriveRequest::kFollow);
  MUST(bench->master.phase() == cia402::ArmingPhase::kArmed);
  // Each record: kind and node, then the bytes of a frame; a kind of its own ends the cycle.
  for (std::size_t at = 0; at < size;) {
    const std::uint8_t kind = data[at++];
    constexpr std::uint16_t kBases[] = {0x080, 0x180, 0x580, 0x700};
    if (kind < 0x40) {
      bench->drives.exchange(bench->master, bench->now_ns);
      bench->cycle();
      check(*bench);
      bench->collect();
      bench->command.request =
          kind < 0x30 ? DriveRequest::kFollow : static_cast<DriveRequest>(kind % 3);
      continue;
    }
    CanFrame frame;
    frame.id = static_cast<std::uint16_t>(kBases[kind >> 6 & 3] + (kind & 7));
    frame.fd = (kind & 8) != 0;
    frame.size = static_cast<std::uint8_t>((kind & 0x30) == 0 ? 12 : (kind & 0x0F));
    for (std::size_t i = 0; i < frame.size && at < size; ++i) frame.data[i] = data[at++];
    bench->arrived.add(0, frame);
  }
  return 0;
}
