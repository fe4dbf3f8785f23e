// SimHal: a simulated robot in virtual time, with the plant linked in. Each write holds its command
// for one period; time passes only then, with enabled drives or without. The same seed gives the
// same bytes.
#pragma once

#include <array>
#include <cstdint>
#include <random>

#include "kernel/core/hal.hpp"
#include "sim_plant/arm/arm.hpp"
#include "sim_plant/arm/ft_sensor.hpp"
#include "sim_plant/arm/plant_params.hpp"
#include "sim_plant/arm/servo.hpp"
#include "sim_plant/arm/sim_drives.hpp"

namespace tactus {

class SimHal final : public Hal {
 public:
  /// Builds the plant with the arm at `initial_q` and the brakes closed. `seed` is for the sensor
  /// noise. kBadValue if a setting is outside its range. [init]
  Status load(const PlantParams& params, std::uint64_t seed);
  /// Sets the cycle period, s; connect() judges it. [init]
  void set_period(double period_s) { period_s_ = period_s; }

  /// Position, velocity and effort, 100 us to 10 ms, a force/torque sensor, and eight digital
  /// outputs. A real UR10 takes no efforts. [any]
  Capabilities capabilities() const override;
  /// Connects to the arm, which stands. kNotOffered for a period out of range, kNotStarted before
  /// load(). [init]
  Status connect(CommandMode mode) override;
  /// Returns the state of `delay_cycles` cycles ago, noise included, with its age, and the present
  /// states of the drives; a second read returns the same. Enabled drives that do not follow exert
  /// the torque that holds the arm: commanding it, or q, or zero velocity, moves nothing.
  /// kNotStarted before connect(). [cyclic]
  Status read(const CycleTime& now, RobotState& state) override;
  /// Holds the command for one period. An effort is exerted without limit and without lag; a
  /// position or velocity is the target of the robot's own servo. The brakes are open while the
  /// drives follow. A command of another mode than that of connect(), one that is not finite or out
  /// of the servo's reach, and a plant that diverges are a fault of all drives, which closes the
  /// brakes. kNotStarted before connect(). [cyclic]
  Status write(const RobotCommand& command) override;
  /// Closes the brakes; the arm stops at once. [any]
  Status disconnect() override;

  /// The arm itself, with the true state without noise and delay. [any]
  const Arm& arm() const { return arm_; }
  /// The digital outputs; they stay as they are set when the wire is closed. [any]
  std::uint32_t outputs() const { return outputs_.value; }
  /// Virtual time since load(), ns. [any]
  std::int64_t time_ns() const { return time_ns_; }

 private:
  void follow(const RobotCommand& command);
  Status drive(const RobotCommand& command);
  void measure();
  void stand_still(const JointVector& tau);
  void close_brakes();
  const RobotState& measured() const;

  Arm arm_;
  FtSensor ft_sensor_;
  Servo servo_;
  CommandMode mode_ = CommandMode::kEffort;
  double servo_time_constant_s_ = 0.0;
  double position_noise_rad_ = 0.0, velocity_noise_rad_s_ = 0.0;
  int delay_cycles_ = 0, arming_cycles_ = 0;
  double period_s_ = 0.0;

  std::mt19937_64 random_;
  std::int64_t time_ns_ = 0;
  DigitalOutputs outputs_;
  bool connected_ = false, follows_ = false;
  SimDrives drives_;
  JointVector tau_ = JointVector::Zero();  // torque of the drives, N m
  std::array<RobotState, kMaxDelayCycles + 1> line_;
  int newest_ = 0;  // index of the latest measurement in the delay line
};

}  // namespace tactus
