// Power: goes from POWER_OFF through POWER_ON and IDLE to RUNNING and back, towards its last goal.
// A command is accepted at once and takes effect later.
#pragma once

#include "sim_plant/ur/parts/settings.hpp"

namespace tactus::ur {

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

}  // namespace tactus::ur
