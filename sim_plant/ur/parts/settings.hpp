// Settings: the settings of an emulated controller.
#pragma once

#include <string_view>

#include "hal/ur/protocol_modes.hpp"
#include "hal/ur/protocol_state.hpp"
#include "sim_plant/ur/motion/body.hpp"
#include "sim_plant/ur/motion/motion.hpp"
#include "sim_plant/ur/motion/safety_limits.hpp"
#include "sim_plant/ur/motion/sensors.hpp"

namespace tactus::ur {

struct Settings {
  Version version;
  Joints initial_q;  ///< rad
  SensorErrors sensor_errors;
  Surroundings surroundings;  ///< none: the arm is bare and touches nothing
  DhTable dh;  ///< of the poses that it shows; the arm moves as a UR10, whatever it says
  // Of the installation, as set on the pendant:
  Vector6 tcp_offset = Vector6::Zero();
  double payload_kg = 0.0;
  Vector3 payload_cog = Vector3::Zero();
  bool switched_on = true;      ///< begin in RUNNING; else in POWER_OFF, as after a start
  double start_time_s = 100.0;  ///< initial time of the controller's clock
  std::string_view serial_number = "2017300001";

  // Durations, s; a real CB3 takes 5 to 10 s to IDLE and 1 to 3 s to RUNNING.
  double power_on_s = 2.0, brake_release_s = 1.0, power_off_s = 0.3;
  double unlock_delay_s = 0.5;  ///< until an unlock on a script port takes effect
  double unlock_wait_s = 5.0;   ///< after a protective stop, until the dashboard may unlock

  // Thresholds that are not published: of C153, rad, and of C157, N m.
  double path_deviation = 0.15;
  Joints collision;
  MotionLimits motion;
  ForceSettings force;
  double freedrive_s = 0.25;  ///< time constant with which the arm slows down if nothing pushes it
  SafetyLimits safety;

  /// Address from which external_control.urp fetches its script; empty: no such program exists.
  std::string_view external_control_host = "";
  int external_control_port = 50002;

  Settings() {
    initial_q << 0.0, -1.5708, 1.5708, -1.5708, -1.5708, 0.0;
    collision << 150.0, 150.0, 70.0, 28.0, 28.0, 28.0;
  }
};

}  // namespace tactus::ur
