// UrHal: how the wire is opened and closed.
#include "hal/ur/ur_hal.hpp"

namespace tactus::ur {

void UrHal::configure(const UrSettings& settings, const Tool& given, int period_us, bool outputs) {
  puts_out_ = outputs;
  settings_ = &settings;
  given_ = given;
  period_us_ = period_us;
  drives_.configure(settings, given, period_us);
}

Status UrHal::connect(CommandMode mode) {
  static_cast<void>(disconnect());
  why_ = Message();
  listened_ = false;
  fault_ = open(mode);
  if (fault_ == Status::kOk)
    clock_.start(state_.timestamp_s, std::int64_t{1000} * period_us_);
  else
    close();
  return fault_;
}

Status UrHal::open(CommandMode mode) {
  if (mode != CommandMode::kPosition) {
    why_ = Message("the robot is commanded in positions only");
    return Status::kNotOffered;
  }
  TRY(check_rate());
  const UrSettings& set = *settings_;
  const Deadline deadline(set.connect_ms);
  TRY(session_.start(set.address.c_str(), set.rtde_port, 1e6 / period_us_, puts_out_, deadline,
                     why_));
  TRY(check_sensor());
  TRY(await_state(deadline));
  TRY(check_arm());
  return drives_.connect(deadline);
}

Status UrHal::check_rate() {
  if (period_us_ == 8000 || period_us_ == 2000) return Status::kOk;
  why_ = Message("[robot] period_us = ");
  why_ << period_us_ << ": a UR takes 8000, or 2000 with an e-Series";
  return Status::kNotOffered;
}

Status UrHal::check_sensor() {
  if (settings_->zero_force == ZeroForce::kOff || session_.version().major >= 5) return Status::kOk;
  why_ = Message("[ur] zero_force: a CB3 has no force sensor to set to zero; set it off");
  return Status::kNotOffered;
}

/// Finds what arming would refuse. An arm without power may not know where it is, and in motion
/// joints and tip may be of different times.
Status UrHal::check_arm() {
  if (!state_.running() || !state_.at_rest()) return Status::kOk;
  return check_before_program(given_, state_, settings_->tip_tolerance, why_);
}

/// Waits for the first data package.
Status UrHal::await_state(const Deadline& deadline) {
  for (std::int64_t left_ns = deadline.left_ns(); left_ns > 0; left_ns = deadline.left_ns()) {
    if (!session_.wait(left_ns)) break;
    int count = 0;
    TRY(session_.receive(state_, count, why_));
    if (count > 0) return Status::kOk;
  }
  why_ = Message("RTDE: no data package within ");
  why_ << deadline.whole_ms() << " ms; check the network or raise connect_ms";
  return Status::kBusTimeout;
}

/// If the negative count does not arrive, the program brakes because no set-points come.
Status UrHal::disconnect() {
  drives_.end_program();
  close();
  if (fault_ == Status::kOk) fault_ = Status::kNotStarted;
  return Status::kOk;
}

void UrHal::close() {
  session_.close();
  drives_.close();
}

}  // namespace tactus::ur
