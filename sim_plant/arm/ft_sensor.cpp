#include "sim_plant/arm/ft_sensor.hpp"

#include "sim_plant/arm/normal_noise.hpp"

namespace tactus {

void FtSensor::load(const PlantParams& params, std::uint64_t seed) {
  *this = FtSensor();
  bias_ << params.ft_bias_force_N, params.ft_bias_moment_Nm;
  noise_force_N_ = params.ft_noise_force_N;
  noise_moment_Nm_ = params.ft_noise_moment_Nm;
  if (params.ft_rate_hz > 0.0) period_ns_ = std::llround(1e9 / params.ft_rate_hz);
  random_.seed(~seed);
}

Vector6 FtSensor::measure(const Vector6& felt, std::int64_t time_ns) {
  if (time_ns < next_ns_) return shown_;
  if (period_ns_ > 0) next_ns_ = (time_ns / period_ns_ + 1) * period_ns_;
  shown_ = felt + bias_;
  for (int i = 0; i < 3; ++i) {
    const NormalPair noise = draw_normal(random_);
    shown_[i] += noise_force_N_ * noise.first;
    shown_[i + 3] += noise_moment_Nm_ * noise.second;
  }
  return shown_;
}

}  // namespace tactus
