// Axis: the CiA 402 part of one drive: state machine, modes of operation, motor torque and brake.
//
// The brake is closed unless operation is enabled in homing or one of the cyclic modes; it opens
// `brake_release_s` later, while the motor's torque acts already. Statusword bit 12 and object
// 60FEh:1, bit 0 show when it has opened. A stop by a ramp is the drive's own velocity loop, which
// begins with the torque in force; at standstill the brake closes and the state changes. A stop
// that coasts closes the brake at once.
#pragma once

#include "sim_plant/drives/axis_homing.hpp"
#include "sim_plant/drives/joint_servo.hpp"
#include "sim_plant/drives/transitions.hpp"

namespace tactus::drives {

/// Of 60A9h. The other ones that a drive may have are of revolutions: 00B44700h is rev/min.
inline constexpr std::uint32_t kIncrementsPerSecond = 0x00B50300;

/// The numbers of one joint's drive.
struct AxisSettings {
  double max_torque_Nm = 87.0;  ///< that the motor has
  std::uint32_t rated_mNm = 3000;
  double torque_share = 1.0;  ///< of it, that 6072h allows
  std::uint32_t velocity_unit = kIncrementsPerSecond;
  double max_speed_rad_s = 2.61;  ///< above it: fault 8400h
  ServoGains gains{400.0};
  double brake_release_s = 0.150;
  bool gravity_by_drive = false;  ///< target torque 0 holds the arm
  HomingSettings homing;
};

/// A joint as its drive measures it.
struct JointSample {
  double q = 0.0, dq = 0.0;  ///< rad, rad/s
  double gravity_Nm = 0.0;   ///< the torque that holds it
};

class Axis {
 public:
  explicit Axis(Dictionary& dictionary) : dictionary_(dictionary), homing_(dictionary) {}

  /// Power comes on: switch on disabled, brake closed; the objects that say what the drive can do.
  /// [any]
  void power_on(const AxisSettings& settings);

  /// Takes a controlword; a command that is not valid in the state is ignored. `causes_gone`: no
  /// error but those that fault reset clears. Returns true if a fault was reset. [any]
  bool command(std::uint16_t controlword, bool causes_gone);
  /// The mode of 6060h comes into force unless operation is enabled. [any]
  void follow_mode();
  /// A fault: transition 13. [any]
  void trip();
  /// The reaction of 6007h to the loss of the master. Returns true for "fault". [any]
  bool abort_connection();
  /// Drops into "switch on disabled", as by a safety input. [any]
  void disable();
  void stick_brake(bool stuck) { brake_stuck_ = stuck; }
  void spoil_homing(HomingFault fault) { homing_.spoil(fault); }

  /// Begins a period of the plant. `own_feed_forward`: the velocity of the target positions is
  /// derived from them. Returns an error of the drive, 0: none. [cyclic]
  std::uint16_t begin_period(const JointSample& sample, double period_s, bool own_feed_forward);
  /// Returns the motor's torque for the next `dt_s`, N m. [cyclic]
  double torque(const JointSample& sample, double dt_s);
  /// Writes the objects that the drive measures and reports. [cyclic]
  void report(const JointSample& sample);

  double period_s() const;  ///< of 60C2h
  cia402::State state() const { return state_; }
  bool braked() const { return brake_; }
  bool referenced() const { return homing_.referenced(); }
  bool powered() const { return motion_ != Motion::kOff; }
  bool servoed() const;  ///< follows a velocity or position by its own loop
  std::uint16_t statusword() const;

 private:
  enum class Motion : std::uint8_t { kOff, kFollow, kRamp, kHold };

  void enter(cia402::State state);
  void stop(std::int64_t option, cia402::State after, bool stays);
  void finish_stop();
  double rad_per_increment() const;
  double velocity_unit() const;  // rad/s
  double torque_limit() const;   // N m
  double torque_unit() const;    // N m per permille
  double follow(const JointSample& sample, double dt_s);
  std::uint16_t watch(const JointSample& sample, double period_s);
  bool homes() const;
  void update_brake(const JointSample& sample, double period_s);

  Dictionary& dictionary_;
  AxisHoming homing_;
  AxisSettings settings_;
  cia402::State state_ = cia402::State::kNotReadyToSwitchOn;
  cia402::State after_ = cia402::State::kNotReadyToSwitchOn;  // a stop
  Motion motion_ = Motion::kOff;
  JointServo servo_;
  std::uint16_t controlword_ = 0;
  bool brake_ = true, brake_stuck_ = false, stays_ = false, limited_ = false;
  double enabled_s_ = 0.0;     // since operation was enabled
  double stopping_s_ = 0.0;    // since a stop began
  double beyond_s_ = 0.0;      // the following error is beyond its window
  double ramp_ = 0.0;          // reference of a stop, rad/s
  double deceleration_ = 0.0;  // rad/s^2
  double demand_Nm_ = 0.0, tau_Nm_ = 0.0;
  double feed_forward_ = 0.0;  // rad/s
  std::int64_t target_before_ = 0;
  bool has_target_ = false;
  double dq_ = 0.0;
};

}  // namespace tactus::drives
