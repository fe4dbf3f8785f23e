// Safety: the safety mode and what leads out of it. A protective stop can be unlocked, on the
// dashboard not before five seconds; a violation only by starting the safety system anew.
#pragma once

#include "sim_plant/ur/settings.hpp"

namespace tactus::ur {

class Safety {
 public:
  explicit Safety(const Settings& settings) : settings_(settings) {}

  /// False: there was a stop already, of the same weight or more.
  bool protective_stop() {
    if (mode_ != SafetyMode::kNormal) return false;
    enter(SafetyMode::kProtectiveStop);
    return true;
  }
  bool violation() { return hard_stop(SafetyMode::kViolation); }
  bool emergency_stop() { return hard_stop(SafetyMode::kRobotEmergencyStop); }

  /// As the dashboard does it. False: not yet.
  bool unlock() {
    if (mode_ != SafetyMode::kProtectiveStop) return true;
    if (since_s_ < settings_.unlock_wait_s) return false;
    release_in_s_ = 0.1;
    return true;
  }
  /// As the script ports do it: silently, and soon.
  void unlock_soon() {
    if (mode_ == SafetyMode::kProtectiveStop && release_in_s_ < 0.0)
      release_in_s_ = settings_.unlock_delay_s;
  }
  void restart() { enter(SafetyMode::kNormal); }

  /// One cycle of `h_s`. True: the mode is another than before. [cyclic]
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
  double release_in_s_ = -1.0;  // negative: nobody has asked
};

}  // namespace tactus::ur
