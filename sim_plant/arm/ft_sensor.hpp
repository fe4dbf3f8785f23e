// FtSensor: a force/torque sensor with bias, white noise and a sample rate of its own; it shows
// each sample until the next.
#pragma once

#include <cstdint>
#include <random>

#include "sim_plant/arm/plant_params.hpp"

namespace tactus {

class FtSensor {
 public:
  /// [init]
  void load(const PlantParams& params, std::uint64_t seed);

  /// Returns the reading at `time_ns`, which must not decrease: force first, N and N m. [cyclic]
  Vector6 measure(const Vector6& felt, std::int64_t time_ns);

 private:
  Vector6 bias_ = Vector6::Zero();
  double noise_force_N_ = 0.0, noise_moment_Nm_ = 0.0;
  std::int64_t period_ns_ = 0, next_ns_ = 0;  // of the samples
  std::mt19937_64 random_;                    // its own, so that it does not affect other noise
  Vector6 shown_ = Vector6::Zero();
};

}  // namespace tactus
