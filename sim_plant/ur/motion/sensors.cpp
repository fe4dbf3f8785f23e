#include "sim_plant/ur/motion/sensors.hpp"

#include "sim_plant/arm/normal_noise.hpp"
#include "sim_plant/arm/robot_mjcf.hpp"

namespace tactus::ur {
namespace {

// Of the torque of a drive: standard deviations of the constant error and of the noise, and the
// largest unknown friction.
constexpr double kBias = 0.005, kNoise = 0.003, kCoulomb = 0.01;
constexpr double kBreakaway_rad = 1e-3;     // of harmonic drives: an order of magnitude
constexpr double kFilter_s = 0.04;          // as of Body::residual()
constexpr double kSpeedNoise_rad_s = 5e-4;  // an assumption
constexpr double kPrecision[2] = {5.0 / 3.0, 0.2 / 3.0}, kAccuracy[2] = {5.5 / 3.0, 0.5 / 3.0};

/// Draws six independent numbers of the standard normal distribution.
Vector6 draw(std::mt19937_64& random) {
  Vector6 drawn;
  for (int i = 0; i < 6; i += 2) {
    const NormalPair pair = draw_normal(random);
    drawn[i] = pair.first;
    drawn[i + 1] = pair.second;
  }
  return drawn;
}

/// Returns a wrench of these sizes.
Vector6 scaled(const Vector6& unit, const double (&size)[2]) {
  Vector6 wrench;
  wrench << size[0] * unit.head<3>(), size[1] * unit.tail<3>();
  return wrench;
}

}  // namespace

Sensors::Sensors(const SensorErrors& errors, const Version& version)
    : errors_(errors), has_sensor_(version.major >= 5), random_(errors.seed) {
  if (!errors_.on) return;
  const Joints torque(robot_mjcf().drive_torque.data());
  bias_ = kBias * torque.cwiseProduct(draw(random_));
  coulomb_ = kCoulomb * torque.cwiseProduct(draw(random_).cwiseMax(-1.0).cwiseMin(1.0));
  wrench_bias_ = scaled(draw(random_), kAccuracy);
  if (!has_sensor_) torque_ = bias_;
}

void Sensors::sample(const Joints& dq, double h_s) {
  if (!errors_.on) return;
  dq_noise_ = kSpeedNoise_rad_s * draw(random_);
  if (has_sensor_) {
    wrench_noise_ = scaled(draw(random_), kPrecision);
    return;
  }
  friction_ = (friction_ + dq * (h_s / kBreakaway_rad)).cwiseMax(-1.0).cwiseMin(1.0);
  const Joints noise = Joints(robot_mjcf().drive_torque.data()).cwiseProduct(draw(random_));
  const Joints raw = bias_ + coulomb_.cwiseProduct(friction_) + kNoise * noise;
  torque_ += (h_s / (kFilter_s + h_s)) * (raw - torque_);
}

Joints Sensors::position(const Joints& q) const {
  return (q / errors_.encoder_step).array().round() * errors_.encoder_step + 0.0;  // not -0.0
}

Joints Sensors::velocity(const Joints& dq) const {
  return dq + dq_noise_;
}

Vector6 Sensors::wrench(const Vector6& felt) const {
  return raw_wrench(felt) - zero_;
}

Vector6 Sensors::raw_wrench(const Vector6& felt) const {
  return errors_.on && has_sensor_ ? Vector6(felt + wrench_bias_ + wrench_noise_) : felt;
}

void Sensors::set_zero(const Vector6& felt) {
  if (errors_.on && has_sensor_) zero_ = felt + wrench_bias_;
}

}  // namespace tactus::ur
