// The two modes of the robot: power and safety.
#pragma once

#include "sim_plant/ur/parts/settings.hpp"

namespace tactus::ur {

/// Power: goes from POWER_OFF through POWER_ON and IDLE to RUNNING and back, towards its last goal.
/// A command is accepted at once and takes effect later.
class Power {
 public:
  explicit Power(const Settings& settings)
      : settings_(settings),
        mode_(settings.switched_on ? RobotMode::kRunning : RobotMode::kPowerOff),
        goal_(mode_) {}

  void switch_on() {
    if (goal_ == RobotMode::kPowerOff) set_goal(RobotMode::kIdle);
  }
  void switch_off() { set_goal(RobotMode::kPowerOff); }
  void release_brakes() { set_goal(RobotMode::kRunning); }

  /// Runs one cycle of `h_s`. [cyclic]
  void tick(double h_s) {
    if (mode_ == goal_) return;
    left_s_ -= h_s;
    if (mode_ == RobotMode::kPowerOff && goal_ != RobotMode::kPowerOff) {
      enter(RobotMode::kPowerOn);
    } else if (left_s_ <= 0.0) {
      if (goal_ == RobotMode::kPowerOff)
        enter(RobotMode::kPowerOff);
      else
        enter(mode_ == RobotMode::kPowerOn ? RobotMode::kIdle : RobotMode::kRunning);
    }
  }

  RobotMode mode() const { return mode_; }
  bool running() const { return mode_ == RobotMode::kRunning && goal_ == mode_; }
  bool powered() const { return mode_ >= RobotMode::kPowerOn; }

 private:
  void set_goal(RobotMode goal) {
    if (goal == goal_) return;
    goal_ = goal;
    start_timer();
  }
  void enter(RobotMode mode) {
    mode_ = mode;
    start_timer();
  }
  /// Starts the timer of the next step.
  void start_timer() {
    left_s_ = goal_ == RobotMode::kPowerOff  ? settings_.power_off_s
              : mode_ == RobotMode::kPowerOn ? settings_.power_on_s
                                             : settings_.brake_release_s;
  }

  const Settings& settings_;
  RobotMode mode_, goal_;
  double left_s_ = 0.0;
};

/// Safety: the safety mode and its releases. A protective stop can be unlocked, on the dashboard
/// only after five seconds; only a restart of the safety system ends a violation.
class Safety {
 public:
  explicit Safety(const Settings& settings) : settings_(settings) {}

  /// Begins a protective stop. False: there is already one, or a graver stop.
  bool protective_stop() {
    if (mode_ != SafetyMode::kNormal) return false;
    enter(SafetyMode::kProtectiveStop);
    return true;
  }
  /// Begins a violation. False: there is already one.
  bool violation() {
    if (mode_ == SafetyMode::kViolation) return false;
    enter(SafetyMode::kViolation);
    return true;
  }

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

 private:
  static constexpr double kRounding_s = 1e-6;  // of the sum of many cycles

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
