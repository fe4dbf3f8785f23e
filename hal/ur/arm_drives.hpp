// ArmDrives: the drives of a UR, which are armed, commanded and stopped together. Arming takes one
// step in every cycle and waits for nothing (hal/ur/drive_phase.hpp).
//
// Nothing resumes into motion: as soon as the program is no longer needed it gets the command to
// end, and the register keeps the negative count until the next arming. A program that begins late,
// or that an operator resumes after a stop, reads it and ends.
#pragma once

#include "hal/ur/dashboard_client.hpp"
#include "hal/ur/drive_phase.hpp"
#include "hal/ur/reported_tool.hpp"
#include "hal/ur/robot_port.hpp"
#include "hal/ur/rtde_client.hpp"
#include "hal/ur/servo_program.hpp"
#include "hal/ur/ur_settings.hpp"
#include "kernel/core/hal.hpp"
#include "kernel/robots/robot_table.hpp"

namespace tactus::ur {

class ArmDrives {
 public:
  /// `why` explains every Status that is not kOk and every fault.
  ArmDrives(RtdeClient& session, Message& why)
      : session_(session), set_points_(session, why), why_(why) {}

  /// Takes the settings, which must outlive the use of the drives, and the tool as the file gives
  /// it: what is NaN is left to the controller. [init]
  void configure(const UrSettings& settings, const Tool& given, int period_us);
  /// Opens the primary port, and the dashboard if the settings may need it. kBadValue,
  /// kConnectionLost, kBusTimeout, kRefusedByRobot. [init]
  Status connect(const Deadline& deadline);
  /// Commands a running program to end, unless that was done. [any]
  void end_program();
  void close();
  /// Compares the calibration that the primary port has told, unless the file accepts any:
  /// hal/ur/arm_calibration.hpp. [cyclic]
  Status compare_arm(const UrState& state);

  /// Takes messages of the robot, and finds a fault of enabled drives in the newest state. [cyclic]
  void watch(const UrState& state);
  /// Takes a step towards what is requested. A fault is in drive(); kConnectionLost or kBusTimeout:
  /// the wire does not work any more. [cyclic]
  Status step(const RobotCommand& command, const UrState& state);

  Drive drive() const;
  /// True if the fault is a stop that the robot reports, and may have a code for. [any]
  bool stopped_by_robot() const;
  DrivePhase phase() const { return phase_; }
  const SetPoints& set_points() const { return set_points_; }
  RobotPort& robot() { return robot_; }

 private:
  void take(DriveRequest request);
  void watch_echo(const UrState& state);
  Status continue_program(const UrState& state);
  bool stopped(const UrState& state) const;
  Status run_phase(const RobotCommand& command, const UrState& state);
  void judge_time();

  // The phases of arming: hal/ur/arming_steps.cpp.
  Status judge_robot(const UrState& state);
  Status release_stop(const UrState& state);
  Status power_on(const UrState& state);
  Status release_brakes(const UrState& state);
  Status clear_register(const UrState& state);
  Status upload();
  void await_program(const UrState& state);
  void compare_tool(const UrState& state);
  Status send_first(const UrState& state);
  Status compare_tip(const UrState& state);

  bool may_get_power(const UrState& state);
  Status take_answer(bool& yes);
  Status lose_port();
  void stop(const UrState& state);
  void enter(DrivePhase phase);
  void fail(Status reason);
  bool first_cycle() const { return cycles_ == 1; }
  int cycles_of(int ms) const { return ms * 1000 / period_us_ + 1; }

  const UrSettings* settings_ = nullptr;
  Tool given_;  // NaN: not given
  int period_us_ = 1;
  ServoProgramText text_;
  std::string_view script_;  // in text_

  RtdeClient& session_;
  SetPoints set_points_;
  RobotPort robot_;
  DashboardClient dashboard_;
  Message& why_;

  DrivePhase phase_ = DrivePhase::kOff;
  DriveRequest request_ = DriveRequest::kDisable;
  Status reason_ = Status::kOk;     // of the fault
  int cycles_ = 0;                  // in this phase of arming
  int attempts_ = 0;                // to release a protective stop
  bool cleared_ = false;            // the register, in this arming
  int settled_ = 0;                 // packets since then
  double packet_s_ = 0.0;           // time stamp of the last packet that was counted
  std::int32_t echo_ = 0;           // the last count that the program has used
  int unused_ = 0;                  // packets since then
  Vector6 held_ = Vector6::Zero();  // rad: the last set-point
  bool alive_ = false;              // our program runs, or may still begin to
  int begins_in_ = 0;               // cycles in which a program that was uploaded may begin
  bool end_sent_ = true;            // our program got the command to end, or there is none
};

}  // namespace tactus::ur
