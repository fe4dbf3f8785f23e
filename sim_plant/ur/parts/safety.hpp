// Safety: the safety mode and its releases. A protective stop can be unlocked, on the dashboard
// only after five seconds; only a restart of the safety system ends a violation.
#pragma once

#include "sim_plant/ur/parts/settings.hpp"

namespace tactus::ur {

class Safety {
 public:
  explicit Safety(const Settings& settings) : settings_(settings) {}

  /// Begins a protective stop. False: there is already one, or a graver stop.
  bool protective_stop() {
    if (mode_ != SafetyMode::kNormal) return false;
    enter(SafetyMode::kProtectiveStop);
    return true;
  }
  bool violation() { return hard_stop(SafetyMode::kViolation); }
  bool emergency_stop() { return hard_stop(SafetyMode::kRobotEmergencyStop); }

  /// Unlocks as the dashboard does. False: too early.
  bool unlock() {
    if (mode_ != SafetyMode::kProtectiveStop) return true;
    if (since_s_ < settings_.unlock_wait_s - kRounding_s) return false;
    release_in_s_ = 0.1;
    return true;
  }
  /// Unlocks as the script ports do: without a reply, after a short delay.
  void unlock_soon() {
    if (mode_ == SafetyMode::kProtectiveStop && release_in_s_ < 0.0)
      release_in_s_ = settings_.unlock_delay_s;
  }
  void restart() { enter(SafetyMode::kNormal); }

  /// Runs one cycle of `h_s`. True: the mode has changed. [cyclic]
  bool tick(double h_s) {
    since_s_ += h_s;
    if (release_in_s_ >= 0.0 && (release_in_s_ -= h_s) < 0.0) enter(SafetyMode::kNormal);
    const bool changed = mode_ != told_;
    told_ = mode_;
    return changed;
  }

  SafetyMode mode() const { return mode_; }
  bool normal() const { return mode_ == SafetyMode::kNormal; }
  bool protective_stopped() const { return mode_ == SafetyMode::kProtectiveStop; }
  bool emergency_stopped() const { return mode_ == SafetyMode::kRobotEmergencyStop; }

 private:
  static constexpr double kRounding_s = 1e-6;  // of the sum of many cycles

  bool hard_stop(SafetyMode mode) {
    if (mode_ == mode) return false;
    enter(mode);
    return true;
  }
  void enter(SafetyMode mode) {
    mode_ = mode;
    since_s_ = 0.0;
    release_in_s_ = -1.0;
  }

  const Settings& settings_;
  SafetyMode mode_ = SafetyMode::kNormal, told_ = SafetyMode::kNormal;
  double since_s_ = 0.0;
  double release_in_s_ = -1.0;  // negative: no release is pending
};

}  // namespace tactus::ur
