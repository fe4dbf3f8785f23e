// What the tests of faults share: the commands of a cycle as its frame has them.
#pragma once

#include "tests/hal/cia402/safety_watch.hpp"
#include "tests/hal/ethercat/master_bench.hpp"

namespace tactus::ethercat {

using drives::FaultKind;
using segment::LineFaultKind;

inline constexpr int kForGood = 1 << 20;  // cycles

/// The outputs of joint `j`, from 0: controlword and torque.
inline const std::uint8_t* outputs_sent(const MasterBench& bench, int j) {
  const std::uint8_t* at = bench.hal.sent.bytes.data() + kFirstDatagram;
  if (at[0] == static_cast<std::uint8_t>(Command::kLrd))  // LWR comes behind it
    at += kDatagramBytes + (get<std::uint16_t>(at + 6) & kLengthBits) + kCounterBytes;
  return at + kDatagramBytes + 4 * j;
}
/// Whether the frame of this cycle enables a drive or makes it exert a torque; others have no
/// outputs.
inline bool enables(const MasterBench& bench) {
  constexpr std::uint16_t kEnableBit = 0x0008;
  bool any = false;
  if (!bench.hal.master.connected()) return false;
  for (int j = 0; j < kDof; ++j)
    any = any || (get<std::uint16_t>(outputs_sent(bench, j)) & kEnableBit) != 0;
  return any;
}
inline bool pushes(const MasterBench& bench) {
  bool any = false;
  if (!bench.hal.master.connected()) return false;
  for (int j = 0; j < kDof; ++j) any = any || get<std::int16_t>(outputs_sent(bench, j) + 2) != 0;
  return any;
}
inline drives::Axis& axis(MasterBench& bench, int j) {
  return bench.hal.line.slave(j).axis();
}
inline std::uint16_t word_sent(const MasterBench& bench, int j) {
  return bench.hal.master.connected() ? get<std::uint16_t>(outputs_sent(bench, j))
                                      : std::uint16_t{0};
}
/// Whether a drive exerts a torque, by its own account and not by what it tells.
inline bool powered(MasterBench& bench) {
  bool any = false;
  for (int j = 0; j < kDof; ++j) any = any || axis(bench, j).powered();
  return any;
}
/// Ends what disturbs line and drives.
inline void inject(MasterBench& bench, int joint, drives::FaultKind kind, std::uint32_t value = 0) {
  bench.add(kind, joint + 1, value);
}
inline void heal(MasterBench& bench) {
  bench.hal.line.clear_faults();
}

using SafetyWatch = cia402::SafetyWatch<MasterBench>;

}  // namespace tactus::ethercat
