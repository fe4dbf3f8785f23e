#include "sim_plant/sim_hal.hpp"

#include <cmath>

#include "sim_plant/normal_noise.hpp"

namespace tactus {

Status SimHal::load(const PlantParams& params, std::uint64_t seed) {
  started_ = enabled_ = false;
  TRY(arm_.load(params));
  position_noise_rad_ = params.position_noise_rad;
  velocity_noise_rad_s_ = params.velocity_noise_rad_s;
  delay_cycles_ = params.delay_cycles;
  servo_time_constant_s_ = params.servo_time_constant_s;
  random_.seed(seed);
  ft_sensor_.load(params, seed);
  time_ns_ = 0;
  return Status::kOk;
}

Capabilities SimHal::capabilities() const {
  Capabilities offered;
  offered.position = offered.velocity = offered.effort = true;
  offered.wrench = true;
  offered.min_period_us = 100;
  offered.max_period_us = 10000;
  return offered;
}

Status SimHal::start(CommandMode mode, RobotState& state) {
  const Capabilities offered = capabilities();
  const Range periods_us = {static_cast<double>(offered.min_period_us),
                            static_cast<double>(offered.max_period_us)};
  if (!periods_us.contains(std::round(period_s_ * 1e6))) return Status::kNotOffered;
  if (!arm_.loaded()) return Status::kNotStarted;
  if (arm_.diverged()) return Status::kDriveFault;
  stand_still(arm_.stand());
  mode_ = mode;
  servo_.start(servo_time_constant_s_, arm_.q());
  started_ = enabled_ = true;
  state = measured();
  return Status::kOk;
}

Status SimHal::read(RobotState& state) {
  if (!started_) return Status::kNotStarted;
  if (arm_.diverged()) return Status::kDriveFault;
  state = measured();
  return Status::kOk;
}

Status SimHal::write(const RobotCommand& command) {
  if (!started_) return Status::kNotStarted;
  if (!enabled_) return Status::kDriveFault;
  Status status = drive(command);
  if (status == Status::kOk && arm_.diverged()) status = Status::kDriveFault;
  if (status != Status::kOk) {
    stop();
    return status;
  }
  time_ns_ += std::llround(period_s_ * 1e9);
  measure();
  return Status::kOk;
}

/// Moves the arm by one period; kDriveFault, and nothing moves, when the command cannot be
/// executed.
Status SimHal::drive(const RobotCommand& command) {
  if (command.mode != mode_ || !command.value.allFinite()) return Status::kDriveFault;
  if (mode_ != CommandMode::kEffort) return servo_.move(arm_, command, period_s_, tau_);
  tau_ = command.value;
  arm_.step(tau_, period_s_);
  return Status::kOk;
}

void SimHal::stop() {
  if (!enabled_) return;
  enabled_ = false;
  arm_.stand();
  stand_still(JointVector::Zero());
}

/// Takes one measurement into the delay line. The noise is drawn here and not in read(), so that
/// it does not depend on how often one reads.
void SimHal::measure() {
  newest_ = (newest_ + 1) % static_cast<int>(line_.size());
  RobotState& sample = line_[static_cast<std::size_t>(newest_)];
  sample = {arm_.q(), arm_.dq(), tau_, ft_sensor_.measure(arm_.ft(), time_ns_)};
  for (int i = 0; i < kDof; ++i) {
    const NormalPair noise = draw_normal(random_);
    sample.q[i] += position_noise_rad_ * noise.first;
    sample.dq[i] += velocity_noise_rad_s_ * noise.second;
  }
}

/// The arm has been standing, its drives at `tau`, for longer than the delay line remembers.
void SimHal::stand_still(const JointVector& tau) {
  tau_ = tau;
  for (std::size_t i = 0; i < line_.size(); ++i) measure();
}

/// The measurement that has just come out of the delay line.
const RobotState& SimHal::measured() const {
  const int size = static_cast<int>(line_.size());
  return line_[static_cast<std::size_t>((newest_ + size - delay_cycles_) % size)];
}

}  // namespace tactus
