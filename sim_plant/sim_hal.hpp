// SimHal: a robot whose other end is the plant linked in, in virtual time. One write is one period:
// the command is held for it, and time passes only then. The same seed gives the same bytes.
#pragma once

#include <array>
#include <cstdint>
#include <random>

#include "kernel/hal.hpp"
#include "sim_plant/arm.hpp"
#include "sim_plant/ft_sensor.hpp"
#include "sim_plant/plant_params.hpp"
#include "sim_plant/servo.hpp"

namespace tactus {

class SimHal final : public Hal {
 public:
  /// Builds the plant; the arm stands at `initial_q` with the brakes closed. `seed` is that of the
  /// sensor noise. kBadValue when a setting is outside its range. [init]
  Status load(const PlantParams& params, std::uint64_t seed);
  /// The cycle period, s; start() judges it. [init]
  void set_period(double period_s) { period_s_ = period_s; }

  /// Position, velocity and effort, 100 us to 10 ms. A real UR10 takes no efforts. A
  /// force/torque sensor. [any]
  Capabilities capabilities() const override;
  /// Enables the drives; the brakes open with the first write. state.tau is the torque that holds
  /// the arm: commanding it, or state.q, or no velocity, moves nothing. kNotOffered for another
  /// period, kNotStarted before load(), kDriveFault once the plant has diverged. [init]
  Status start(CommandMode mode, RobotState& state) override;
  /// The state of `delay_cycles` cycles ago, noise included; reading twice gives it twice.
  /// kNotStarted before the first start(), kDriveFault once the plant has diverged. [cyclic]
  Status read(RobotState& state) override;
  /// Holds the command for one period. An effort is exerted without limit and without lag; a
  /// position or velocity is the target of the robot's own servo. A command of another mode than
  /// at start, one that is not finite or out of the servo's reach, and a plant that diverges close
  /// the brakes; from then on, and after stop(), kDriveFault, and time stands still. [cyclic]
  Status write(const RobotCommand& command) override;
  /// Closes the brakes: the arm stands where it is. [any]
  void stop() override;

  /// The arm itself, that is the true state without noise and delay. [any]
  const Arm& arm() const { return arm_; }
  /// Virtual time since load(), ns. [any]
  std::int64_t time_ns() const { return time_ns_; }

 private:
  Status drive(const RobotCommand& command);
  void measure();
  void stand_still(const JointVector& tau);
  const RobotState& measured() const;

  Arm arm_;
  FtSensor ft_sensor_;
  Servo servo_;
  CommandMode mode_ = CommandMode::kEffort;
  double servo_time_constant_s_ = 0.0;
  double position_noise_rad_ = 0.0, velocity_noise_rad_s_ = 0.0;
  int delay_cycles_ = 0;
  double period_s_ = 0.0;

  std::mt19937_64 random_;
  std::int64_t time_ns_ = 0;
  bool started_ = false, enabled_ = false;
  JointVector tau_ = JointVector::Zero();  // N m, what the drives exert
  std::array<RobotState, kMaxDelayCycles + 1> line_;
  int newest_ = 0;  // index of the latest measurement in the delay line
};

}  // namespace tactus
