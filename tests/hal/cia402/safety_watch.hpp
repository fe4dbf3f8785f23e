// What must hold after every cycle, over any wire.
#pragma once

#include "kernel/core/joint_limits.hpp"
#include "tests/hal/cia402/loop_bench.hpp"

namespace tactus::cia402 {

/// Of a bench of any wire with enables(), pushes() and powered(), which say what its frames command
/// and whether a drive has power, and with the arm at plant_q() and plant_dq().
template <class Bench>
class SafetyWatch {
 public:
  explicit SafetyWatch(Bench& bench) : bench_(bench) {}

  /// Runs a cycle and judges it: frames that enable or push only while the drives are armed or
  /// follow, finite values, and no joint faster than its limit.
  Status cycle() {
    const Rung before = bench_.executive.rung();
    const Status status = bench_.cycle();
    const Rung after = bench_.executive.rung();
    // A brake that ends, and an arming that takes too long, are found after the frames were sent.
    Event last;
    const EventLog& events = bench_.executive.events();
    const bool late = before != Rung::kDisabled && after == Rung::kDisabled &&
                      events.read(events.count() - 1, last) &&
                      (last.cause == Cause::kAtRest || last.cause == Cause::kStopTime ||
                       last.cause == Cause::kArmTime);
    if (after == Rung::kDisabled && !late) {
      assert_false(enables(bench_));
      assert_false(pushes(bench_));
    }
    const JointVector q = bench_.plant_q(), dq = bench_.plant_dq();
    assert_true(q.allFinite() && dq.allFinite());
    for (int j = 0; j < kDof; ++j) {
      const double share = std::abs(dq[j]) / limits_.dq_max[j];
      if (share > fastest_) fastest_ = share;
      assert_true(share <= 1.0);
    }
    off_ = powered(bench_) ? off_ : 0;
    if (after == Rung::kDisabled && powered(bench_)) ++off_;
    if (off_ > longest_off_) longest_off_ = off_;
    return status;
  }
  /// Cycles on "disabled" until no drive had power, at most until now.
  int longest_off() const { return longest_off_; }
  /// The fastest joint until now, as a share of its limit.
  double fastest() const { return fastest_; }

 private:
  Bench& bench_;
  JointLimits limits_;
  int off_ = 0, longest_off_ = 0;
  double fastest_ = 0.0;
};

}  // namespace tactus::cia402
