// What the tests of faults share: the layouts of the buses, and the commands of a cycle as the
// frames have them.
#pragma once

#include "tests/hal/cia402/safety_watch.hpp"
#include "tests/sim_plant/drives/master_bench.hpp"

namespace tactus::can {

enum class Buses : std::uint8_t { kFdPacked, kFdPlain, kClassicPlain, kClassicPacked };

/// One bus, two, three and two of them.
inline void lay_out(MasterBench& bench, Buses buses) {
  const bool fd = buses == Buses::kFdPacked || buses == Buses::kFdPlain;
  const bool packed = buses == Buses::kFdPacked || buses == Buses::kClassicPacked;
  bench.can.frames = fd ? Frames::kFd : Frames::kClassic;
  bench.can.commands = packed ? Commands::kPacked : Commands::kPlain;
  bench.can.load_share = 0.9;
  if (buses == Buses::kClassicPlain) {
    bench.can.interfaces = Value("vcan0 vcan1 vcan2");
    bench.can.bus << 1, 1, 1, 2, 2, 3, 3;
  }
  if (buses == Buses::kClassicPacked || buses == Buses::kFdPlain) {
    bench.can.interfaces = Value("vcan0 vcan1");
    bench.can.bus << 1, 1, 1, 1, 2, 2, 2;
  }
}

/// The command of joint `j`, from 0, in the frames of a cycle, by the layouts of the bus.
struct CommandSeen {
  bool has_word = false, has_torque = false;
  std::uint16_t word = 0;
  std::int16_t torque = 0;
};
inline CommandSeen command_seen(const MasterBench& bench, int j) {
  const bool fd = bench.can.frames == Frames::kFd, plain = bench.can.commands == Commands::kPlain;
  const int first = plain ? j : fd || j < 4 ? 0 : 4;  // joint, with node j + 1
  const auto place = static_cast<std::size_t>(j - first);
  CommandSeen seen;
  for (const CanFrame& frame : bench.hal.sent) {
    const bool split = !fd && !plain;
    if (frame.id == 0x201 + first) {
      seen.has_word = true;
      seen.has_torque = seen.has_torque || !split;
      seen.word = can::load<std::uint16_t>(frame.data, split ? 2 * place : 4 * place);
      if (!split) seen.torque = can::load<std::int16_t>(frame.data, 4 * place + 2);
    }
    if (split && frame.id == 0x301 + first) {
      seen.has_torque = true;
      seen.torque = can::load<std::int16_t>(frame.data, 2 * place);
    }
  }
  return seen;
}

/// Identifier of the frame with the torque of joint `j`, or with its controlword.
inline std::uint16_t command_id(const MasterBench& bench, int j, bool word = false) {
  const bool fd = bench.can.frames == Frames::kFd;
  if (bench.can.commands == Commands::kPlain) return static_cast<std::uint16_t>(0x201 + j);
  if (fd) return 0x201;
  return static_cast<std::uint16_t>((word ? 0x201 : 0x301) + (j < 4 ? 0 : 4));
}

/// Whether the frames of this cycle enable a drive or make it exert a torque.
inline bool enables(const MasterBench& bench) {
  constexpr std::uint16_t kEnableBit = 0x0008;
  bool any = false;
  for (int j = 0; j < kDof; ++j) any = any || (command_seen(bench, j).word & kEnableBit) != 0;
  return any;
}
inline bool pushes(const MasterBench& bench) {
  bool any = false;
  if (bench.pipeline.robot.mode() != CommandMode::kEffort) return false;  // the drives' own matter
  for (int j = 0; j < kDof; ++j) any = any || command_seen(bench, j).torque != 0;
  return any;
}
inline drives::Axis& axis(MasterBench& bench, int j) {
  return bench.hal.arm.node(j).axis();
}
inline std::uint16_t word_sent(const MasterBench& bench, int j) {
  return command_seen(bench, j).word;
}
/// Whether a drive exerts a torque, by its own account and not by what it tells.
inline bool powered(MasterBench& bench) {
  bool any = false;
  for (int j = 0; j < kDof; ++j) any = any || axis(bench, j).powered();
  return any;
}

/// Ends what disturbs wire and drives.
inline void heal(MasterBench& bench) {
  bench.hal.disturbance = {};
  bench.hal.down = false;
  for (int j = 0; j < kDof; ++j) bench.hal.arm.node(j).faults().clear();
}

/// Disturbs the frames with identifier `id` in the next `count` cycles.
inline void disturb(MasterBench& bench, Wire wire, bool to_drive, int id, int count) {
  const int now = bench.hal.cycle;
  bench.hal.disturbance = {wire, to_drive, static_cast<std::uint16_t>(id), now, now + count - 1};
}
inline void inject(MasterBench& bench, int joint, drives::FaultKind kind, std::uint32_t value = 0) {
  drives::Fault fault;
  fault.kind = kind;
  fault.value = value;
  assert_true(bench.hal.arm.node(joint).faults().add(fault));
}
inline CanFrame foreign(int id, std::initializer_list<int> bytes) {
  CanFrame frame;
  frame.id = static_cast<std::uint16_t>(id);
  for (const int byte : bytes) frame.data[frame.size++] = static_cast<std::uint8_t>(byte);
  return frame;
}

using SafetyWatch = cia402::SafetyWatch<MasterBench>;

/// A bench of its own for a run; the last one is deleted, so that a failed test leaves nothing.
inline MasterBench& fresh_bench(Buses buses = Buses::kFdPacked) {
  static MasterBench* bench = nullptr;
  delete bench;
  bench = new MasterBench;
  lay_out(*bench, buses);
  return *bench;
}

}  // namespace tactus::can
