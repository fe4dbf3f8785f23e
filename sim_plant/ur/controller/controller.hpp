// Controller: the emulated robot without its network. One call of tick() is one cycle; it uses no
// clock and no sockets.
#pragma once

#include "sim_plant/ur/controller/dashboard.hpp"
#include "sim_plant/ur/wire/image.hpp"

namespace tactus::ur {

/// Faults that a test can switch on.
struct Faults {
  bool frozen_stamp = false;               ///< the time on all ports does not change
  bool nan_positions = false;              ///< actual_q is NaN
  Joints push = Joints::Zero();            ///< joint torques on the arm, N m
  Joints encoder_offset = Joints::Zero();  ///< added to actual_q, rad
};

class Controller {
 public:
  explicit Controller(const Settings& settings)
      : machine_(settings), dashboard_(runner_, machine_), limits_(settings.safety) {}
  Controller(const Controller&) = delete;
  Controller& operator=(const Controller&) = delete;

  /// Starts with the arm at rest at the initial position of the settings. [init]
  Status start();
  void tick();

  const Image& image() const { return image_; }
  Machine& machine() { return machine_; }
  const Machine& machine() const { return machine_; }
  Runner& runner() { return runner_; }
  Dashboard& dashboard() { return dashboard_; }
  Faults& faults() { return faults_; }

 private:
  void run_program();
  void scale_speed();
  void move_targets();
  void carry_arm();
  void watch_arm();
  void watch_force_limits(const Joints& q);
  void watch_limits(const Joints& q);
  void say_changes();
  void show();
  void show_tool();
  void show_io();
  void show_modes();

  Machine machine_;
  Runner runner_;
  Dashboard dashboard_;
  LimitWatch limits_;
  Faults faults_;
  Image image_;
  Joints dq_before_ = Joints::Zero();  // target speeds of the last cycle
  Vector3 tcp_speed_before_ = Vector3::Zero();
};

}  // namespace tactus::ur
