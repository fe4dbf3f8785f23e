// FtSensor: what a force/torque sensor makes of the wrench it feels: bias, white noise, and a rate
// of its own, between whose samples it shows the last one.
#pragma once

#include <cstdint>
#include <random>

#include "sim_plant/plant_params.hpp"

namespace tactus {

class FtSensor {
 public:
  /// [init]
  void load(const PlantParams& params, std::uint64_t seed);

  /// What it shows at `time_ns`, which never goes back: force first, N and N m. [cyclic]
  Vector6 measure(const Vector6& felt, std::int64_t time_ns);

 private:
  Vector6 bias_ = Vector6::Zero();
  double noise_force_N_ = 0.0, noise_moment_Nm_ = 0.0;
  std::int64_t period_ns_ = 0, next_ns_ = 0;  // of its samples
  std::mt19937_64 random_;                    // its own, so that its noise changes nobody else's
  Vector6 shown_ = Vector6::Zero();
};

}  // namespace tactus
