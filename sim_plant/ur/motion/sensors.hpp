// Sensors: what the controller measures of the arm, with the errors that a real one has.
//
// Encoders. Positions are multiples of a step. The manufacturer publishes no figure; 19 bits per
// turn, 1.2e-5 rad, are our assumption.
//
// Force of a CB3. It has no sensor: the force is estimated from the motor currents. An employee of
// the manufacturer gives +-10 N and +-5 N m ("Internal Force Sensor properties", forum of Universal
// Robots); in the same thread ten weighings of 3 kg by a UR5 differ by 3.6 N rms, and their mean is
// 6 N off. Here each joint's torque has a constant error, friction that the model does not know,
// and white noise; the low-pass of the estimate follows. On 0.6 m of arm these are 3 N, up to 5 N
// and 0.5 N:
//
//   e = bias + coulomb z + noise,   dz = dq / breakaway while |z| <= 1
//
// At rest z stays, as friction does: the error depends on how the arm came to its place.
//
// Force of an e-Series. It has a sensor at the flange. Of the UR10e the data sheet gives a
// precision of 5 N and 0.2 N m and an accuracy of 5.5 N and 0.5 N m (from memory); each is taken as
// three standard deviations, of white noise and of a constant error. zero_ftsensor() removes the
// latter.
#pragma once

#include <random>

#include "hal/ur/protocol_state.hpp"
#include "sim_plant/ur/motion/kinematics.hpp"

namespace tactus::ur {

struct SensorErrors {
  bool on = false;         ///< of force and noise; off, tests and clients find exact numbers
  std::uint64_t seed = 1;  ///< the same seed gives the same errors
  double encoder_step = 6.283185307179586 / (1 << 19);  ///< rad; always
};

class Sensors {
 public:
  Sensors(const SensorErrors& errors, const Version& version);

  /// Draws the errors of a cycle of `h_s`; the joints move at `dq`, rad/s. [cyclic]
  void sample(const Joints& dq, double h_s);

  Joints position(const Joints& q) const;                 ///< as the encoders show it, rad
  Joints velocity(const Joints& dq) const;                ///< rad/s
  const Joints& torque_error() const { return torque_; }  ///< of the estimate, filtered, N m
  /// Returns the wrench as the sensor shows it, N and N m; without errors or sensor, `felt`. [any]
  Vector6 wrench(const Vector6& felt) const;
  /// The same of a sensor that was never set to zero.
  Vector6 raw_wrench(const Vector6& felt) const;
  /// Takes the present reading of the sensor as zero; a CB3 has none. [cyclic]
  void set_zero(const Vector6& felt);

 private:
  SensorErrors errors_;
  bool has_sensor_;  // of an e-Series
  std::mt19937_64 random_;
  Joints bias_ = Joints::Zero(), coulomb_ = Joints::Zero(), friction_ = Joints::Zero();
  Joints torque_ = Joints::Zero(), dq_noise_ = Joints::Zero();
  Vector6 wrench_bias_ = Vector6::Zero(), wrench_noise_ = Vector6::Zero();
  Vector6 zero_ = Vector6::Zero();
};

}  // namespace tactus::ur
