// DrivenArm: the arm of this build moved by the axes of its drives, over whatever bus they are
// commanded: motors, and brakes that hold their joints.
#pragma once

#include <array>

#include "kernel/core/status.hpp"
#include "sim_plant/arm/arm.hpp"
#include "sim_plant/drives/axis.hpp"

namespace tactus::drives {

struct DrivenArmSettings {
  bool gravity_by_drive = false;  ///< target torque 0 holds the arm
  double brake_release_s = 0.150;
  std::int64_t store_ns = 0;                           ///< until 1010h:1 is answered
  std::uint32_t velocity_unit = kIncrementsPerSecond;  ///< 60A9h
  double torque_share = 1.0;                           ///< of the motor's torque, that 6072h allows
  std::array<HomingSettings, kDof> homing{};
  PlantParams plant;
};

/// The drive of a joint, from 0, of the robot of this build. [any]
AxisSettings axis_settings(const DrivenArmSettings& settings, std::size_t joint);

class DrivenArm {
 public:
  /// An axis of each joint; null: the joint has no drive, and its brake is closed.
  using Axes = std::array<Axis*, kDof>;

  /// Builds the arm with its brakes closed. kBadValue if a setting is outside its range. Allocates
  /// the arm's memory. [init]
  Status load(const DrivenArmSettings& settings, const Axes& axes);

  /// Moves the arm by one period with the commands in force. The drives have begun theirs. [cyclic]
  void move(double period_s);
  /// A joint as its drive measures it. [cyclic]
  JointSample sample(int joint) const { return {q_[joint], dq_[joint], gravity_[joint]}; }

  Arm& arm() { return arm_; }
  std::int64_t periods() const { return periods_; }  ///< that the arm has moved

 private:
  void step(double period_s);
  JointVector with_brakes(const JointVector& tau);
  void measure();
  void recover();

  DrivenArmSettings settings_;
  Arm arm_;
  Axes axes_{};
  std::array<bool, kDof> braked_{};
  JointVector held_q_ = JointVector::Zero();  // where the brakes closed, rad
  JointVector gravity_ = JointVector::Zero();
  JointVector q_ = JointVector::Zero(), dq_ = JointVector::Zero();
  std::int64_t periods_ = 0;
};

}  // namespace tactus::drives
