// What the tests of faults share: the commands of a cycle as its frame has them, and what must hold
// in every cycle.
#pragma once

#include "tests/ethercat/master_bench.hpp"

namespace tactus::ethercat {

using drives::FaultKind;
using segment::LineFaultKind;

inline constexpr int kForGood = 1 << 20;  // cycles

/// The outputs of joint `j`, from 0: controlword and torque.
inline const std::uint8_t* outputs_sent(const MasterBench& bench, int j) {
  return bench.hal.sent.bytes.data() + kFirstDatagram + kDatagramBytes + 4 * j;
}
/// Whether the frame of this cycle enables a drive or makes it exert a torque.
inline bool enables(const MasterBench& bench) {
  constexpr std::uint16_t kEnableBit = 0x0008;
  bool any = false;
  for (int j = 0; j < kDof; ++j)
    any = any || (get<std::uint16_t>(outputs_sent(bench, j)) & kEnableBit) != 0;
  return any;
}
inline bool pushes(const MasterBench& bench) {
  bool any = false;
  for (int j = 0; j < kDof; ++j) any = any || get<std::int16_t>(outputs_sent(bench, j) + 2) != 0;
  return any;
}
/// Whether a drive exerts a torque, by its own account and not by what it tells.
inline bool powered(MasterBench& bench) {
  bool any = false;
  for (int j = 0; j < kDof; ++j) any = any || bench.hal.line.slave(j).axis().powered();
  return any;
}
/// Ends what disturbs line and drives.
inline void heal(MasterBench& bench) {
  bench.hal.line.clear_faults();
}

/// What must hold after every cycle.
class SafetyWatch {
 public:
  explicit SafetyWatch(MasterBench& bench) : bench_(bench) {}

  /// Runs a cycle and judges it: frames that enable or push only while the drives are armed or
  /// follow, finite values, and no joint faster than its limit.
  Status cycle() {
    const Rung before = bench_.executive.rung();
    const Status status = bench_.cycle();
    const Rung after = bench_.executive.rung();
    // A brake that ends, and an arming that takes too long, are found after the frame was sent.
    Event last;
    const EventLog& events = bench_.executive.events();
    const bool late = before != Rung::kDisabled && after == Rung::kDisabled &&
                      events.read(events.count() - 1, last) &&
                      (last.cause == Cause::kAtRest || last.cause == Cause::kStopTime ||
                       last.cause == Cause::kArmTime);
    if (after == Rung::kDisabled && !late && bench_.hal.master.connected()) {
      assert_false(enables(bench_));
      assert_false(pushes(bench_));
    }
    const JointVector q = bench_.hal.line.arm().arm().q(), dq = bench_.hal.line.arm().arm().dq();
    assert_true(q.allFinite() && dq.allFinite());
    for (int j = 0; j < kDof; ++j) {
      const double share = std::abs(dq[j]) / limits_.dq_max[j];
      if (share > fastest_) fastest_ = share;
      assert_true(share <= 1.0);
    }
    off_ = after == Rung::kDisabled && powered(bench_) ? off_ + 1 : 0;
    if (off_ > longest_off_) longest_off_ = off_;
    return status;
  }
  /// Cycles on "disabled" until no drive had power, at most until now.
  int longest_off() const { return longest_off_; }
  double fastest() const { return fastest_; }  ///< joint until now, as a share of its limit

 private:
  MasterBench& bench_;
  JointLimits limits_;
  int off_ = 0, longest_off_ = 0;
  double fastest_ = 0.0;
};

/// A bench of its own for a run; the last one is deleted, so that a failed test leaves nothing.
inline MasterBench& fresh_bench() {
  static MasterBench* bench = nullptr;
  delete bench;
  return *(bench = new MasterBench);
}

}  // namespace tactus::ethercat
