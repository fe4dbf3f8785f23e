// GuardedHal: a robot that follows its commands exactly, of unit inertia under torques, and traps
// on a command beyond its limits.
#pragma once

#include "kernel/guard/guard.hpp"
#include "tests/fuzz/fuzzing.hpp"

namespace tactus::fuzz {

class GuardedHal final : public Hal {
 public:
  /// At rest at `q`; commands must keep `limits`.
  GuardedHal(const JointVector& q, const JointLimits& limits, double period_s)
      : limits_(limits), period_s_(period_s) {
    state_.q = q;
  }

  Capabilities capabilities() const override { return {true, true, true, 100, 100000, true}; }
  Status connect(CommandMode) override { return Status::kOk; }
  Status read(const CycleTime& now, RobotState& state) override {
    state = state_;
    state.stamp_ns = now.stamp_ns;
    state.drives.fill({enabled_ ? DriveState::kEnabled : DriveState::kDisabled, true});
    return Status::kOk;
  }
  Status write(const RobotCommand& command) override {
    enabled_ = command.request != DriveRequest::kDisable;
    if (command.request != DriveRequest::kFollow) return Status::kOk;
    MUST(command.value.allFinite());
    const JointVector& value = command.value;
    if (command.mode == CommandMode::kEffort) {
      judge(value, limits_.tau_max);
      judge(value - state_.tau, limits_.dtau_max * period_s_);
      state_.tau = value;
      state_.dq += value * period_s_;
      state_.q += state_.dq * period_s_;
      return Status::kOk;
    }
    const bool position = command.mode == CommandMode::kPosition;
    const JointVector dq = position ? JointVector((value - state_.q) / period_s_) : value;
    judge(dq, limits_.dq_max);
    judge(dq - state_.dq, limits_.ddq_max * period_s_);
    state_.dq = dq;
    state_.q = position ? value : JointVector(state_.q + dq * period_s_);
    MUST((state_.q - limits_.q_max).maxCoeff() <= kBeyond);
    MUST((limits_.q_min - state_.q).maxCoeff() <= kBeyond);
    return Status::kOk;
  }
  Status disconnect() override {
    enabled_ = false;
    return Status::kOk;
  }

 private:
  static constexpr double kBeyond = 1e-6;  // the guard's allowances and rounding, in every unit

  static void judge(const JointVector& value, const JointVector& limit) {
    MUST((value.cwiseAbs() - limit).maxCoeff() <= kBeyond);
  }

  JointLimits limits_;
  double period_s_;
  RobotState state_;
  bool enabled_ = false;
};

}  // namespace tactus::fuzz
