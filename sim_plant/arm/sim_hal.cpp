#include "sim_plant/arm/sim_hal.hpp"

#include <cmath>

#include "sim_plant/arm/normal_noise.hpp"

namespace tactus {

Status SimHal::load(const PlantParams& params, std::uint64_t seed) {
  connected_ = follows_ = false;
  TRY(arm_.load(params));
  position_noise_rad_ = params.position_noise_rad;
  velocity_noise_rad_s_ = params.velocity_noise_rad_s;
  delay_cycles_ = params.delay_cycles;
  arming_cycles_ = params.arming_cycles;
  servo_time_constant_s_ = params.servo_time_constant_s;
  random_.seed(seed);
  ft_sensor_.load(params, seed);
  time_ns_ = 0;
  outputs_ = {};
  return Status::kOk;
}

Capabilities SimHal::capabilities() const {
  Capabilities offered;
  offered.position = offered.velocity = offered.effort = true;
  offered.wrench = offered.velocity_feed_forward = true;
  offered.outputs = 0xff;
  offered.min_period_us = 100;
  offered.max_period_us = 10000;
  return offered;
}

Status SimHal::connect(CommandMode mode) {
  const Capabilities offered = capabilities();
  const Range periods_us = {static_cast<double>(offered.min_period_us),
                            static_cast<double>(offered.max_period_us)};
  if (!periods_us.contains(std::round(period_s_ * 1e6))) return Status::kNotOffered;
  if (!arm_.loaded()) return Status::kNotStarted;
  static_cast<void>(disconnect());
  mode_ = mode;
  drives_.start(arming_cycles_);
  connected_ = true;
  arm_.stand();
  stand_still(JointVector::Zero());
  return Status::kOk;
}

Status SimHal::read(const CycleTime& now, RobotState& state) {
  if (!connected_) return Status::kNotStarted;
  state = measured();
  state.stamp_ns += now.stamp_ns - time_ns_;
  const bool failed = drives_.state() == DriveState::kFault;
  state.drives.fill({drives_.state(), true, failed ? Status::kDriveFault : Status::kOk});
  return Status::kOk;
}

Status SimHal::write(const RobotCommand& command) {
  if (!connected_) return Status::kNotStarted;
  outputs_.set(command.outputs);
  const bool was_enabled = drives_.state() == DriveState::kEnabled;
  drives_.step(command.request);
  if (arm_.diverged()) drives_.fail();
  const bool enabled = drives_.state() == DriveState::kEnabled;
  if (enabled && !was_enabled) stand_still(arm_.stand());
  if (!enabled && was_enabled) close_brakes();
  if (enabled && was_enabled && command.request == DriveRequest::kFollow) follow(command);
  time_ns_ += std::llround(period_s_ * 1e9);
  measure();
  return Status::kOk;
}

/// Moves the arm for one period; a command that cannot be executed is a fault of the drives.
void SimHal::follow(const RobotCommand& command) {
  if (!follows_) servo_.start(servo_time_constant_s_, arm_.q());
  follows_ = true;
  if (drive(command) == Status::kOk && !arm_.diverged()) return;
  drives_.fail();
  close_brakes();
}

/// Moves the arm for one period. kDriveFault, and nothing moves, if the command cannot be executed.
Status SimHal::drive(const RobotCommand& command) {
  if (command.mode != mode_ || !command.value.allFinite() || !command.dq_ff.allFinite())
    return Status::kDriveFault;
  if (mode_ != CommandMode::kEffort) return servo_.move(arm_, command, period_s_, tau_);
  tau_ = command.value;
  arm_.step(tau_, period_s_);
  return Status::kOk;
}

Status SimHal::disconnect() {
  if (connected_) close_brakes();
  connected_ = false;
  return Status::kOk;
}

/// Stops the arm at once.
void SimHal::close_brakes() {
  follows_ = false;
  arm_.stand();
  stand_still(JointVector::Zero());
}

/// Takes one measurement into the delay line. The noise is drawn here and not in read(), so that it
/// does not depend on the number of reads.
void SimHal::measure() {
  newest_ = (newest_ + 1) % static_cast<int>(line_.size());
  RobotState& sample = line_[static_cast<std::size_t>(newest_)];
  sample.q = arm_.q();
  sample.dq = arm_.dq();
  sample.tau = tau_;
  sample.ft = ft_sensor_.measure(arm_.ft(), time_ns_);
  sample.stamp_ns = time_ns_;
  for (int i = 0; i < kDof; ++i) {
    const NormalPair noise = draw_normal(random_);
    sample.q[i] += position_noise_rad_ * noise.first;
    sample.dq[i] += velocity_noise_rad_s_ * noise.second;
  }
}

/// Fills the delay line with an arm at rest and drives at `tau`.
void SimHal::stand_still(const JointVector& tau) {
  tau_ = tau;
  for (std::size_t i = 0; i < line_.size(); ++i) measure();
}

/// Returns the measurement at the end of the delay line.
const RobotState& SimHal::measured() const {
  const int size = static_cast<int>(line_.size());
  return line_[static_cast<std::size_t>((newest_ + size - delay_cycles_) % size)];
}

}  // namespace tactus
