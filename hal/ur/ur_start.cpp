// The start of a UR: from the first connection until its program waits for set-points.
#include "hal/ur/ur_hal.hpp"

namespace tactus::ur {
namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;

}  // namespace

Status UrHal::start(CommandMode mode, RobotState& state) {
  close();
  why_ = Message();
  count_ = unsent_ = 0;
  fault_ = mode == CommandMode::kPosition ? attach() : Status::kNotOffered;
  if (fault_ != Status::kOk) return close(), fault_;
  clock_.start(state_.timestamp_s, std::int64_t{1000} * period_us_);
  show(state);
  return Status::kOk;
}

Status UrHal::attach() {
  const UrSettings& set = *settings_;
  TRY(session_.start(set.address.c_str(), set.rtde_port, 1e6 / period_us_, set.connect_ms, why_));
  TRY(check_settings());
  TRY(next_state());
  TRY(robot_.connect(set.address.c_str(), set.primary_port, set.connect_ms, why_));
  TRY(prepare());
  TRY(stop_other_program());
  TRY(come_to_rest());
  return upload_program();
}

Status UrHal::look(RobotState& state) {
  const UrSettings& set = *settings_;
  close();
  why_ = Message();
  Status status =
      session_.start(set.address.c_str(), set.rtde_port, 1e6 / period_us_, set.connect_ms, why_);
  if (status == Status::kOk) status = next_state();
  if (status == Status::kOk) show(state);
  return close(), status;
}

Status UrHal::check_settings() {
  if (period_us_ != 8000 && period_us_ != 2000) {
    why_ = Message("[robot] period_us is ");
    why_ << period_us_ << ", neither 8000 nor 2000";
    return Status::kNotOffered;
  }
  if (settings_->zero_force == ZeroForce::kOff || session_.version().major >= 5) return Status::kOk;
  why_ = Message("[ur] zero_force: a CB3 has no force sensor to set to zero");
  return Status::kNotOffered;
}

/// The next data package, and what the robot has to say beside it.
Status UrHal::next_state() {
  constexpr int kMostPieces = 64;
  for (int i = 0, count = 0; i < kMostPieces; ++i) {
    if (!session_.wait(settings_->connect_ms * kMillisecond_ns)) break;
    TRY(session_.receive(state_, count, why_));
    robot_.receive();
    if (count > 0) return Status::kOk;
  }
  why_ = Message("RTDE: no data package within ");
  why_ << settings_->connect_ms << " ms";
  return Status::kBusTimeout;
}

/// Time is counted in packets.
template <class Done>
Status UrHal::await(Done done, int timeout_ms, const char* what) {
  const int packets = timeout_ms * 1000 / period_us_ + 1;
  for (int i = 0; i < packets; ++i) {
    TRY(next_state());
    if (done()) return Status::kOk;
  }
  why_ = Message(what);
  why_ << ": not within " << timeout_ms << " ms";
  return Status::kRefusedByRobot;
}

/// What the settings allow to be done about a robot that may not move. An emergency or safeguard
/// stop is for people to release.
Status UrHal::prepare() {
  Status status = judge_modes(state_, why_);
  const bool releases = settings_->on_protective_stop == OnProtectiveStop::kRelease;
  if (status == Status::kProtectiveStop && releases) {
    TRY(release_stop());
    status = judge_modes(state_, why_);
  }
  const bool has_power_to_get = state_.robot_mode >= static_cast<int>(RobotMode::kPowerOff) &&
                                state_.robot_mode <= static_cast<int>(RobotMode::kIdle);
  if (status == Status::kRobotMode && has_power_to_get &&
      settings_->on_power_off == OnPowerOff::kPowerOn) {
    TRY(power_on());
    status = judge_modes(state_, why_);
  }
  return status;
}

/// The dashboard refuses for 5 s after the stop.
Status UrHal::release_stop() {
  constexpr int kAttempts = 7, kBetween_ms = 1000;
  const UrSettings& set = *settings_;
  TRY(dashboard_.connect(set.address.c_str(), set.dashboard_port, set.connect_ms, why_));
  Status status = Status::kRefusedByRobot;
  const auto released = [this] {
    Message unused;
    return judge_modes(state_, unused) != Status::kProtectiveStop;
  };
  for (int i = 0; i < kAttempts && status == Status::kRefusedByRobot; ++i) {
    status = dashboard_.ask("unlock protective stop", "Protective stop releasing", why_);
    if (status == Status::kOk)
      return await(released, set.power_ms, "release of the protective stop");
    const Message refusal = why_;
    const Status waited = await(released, kBetween_ms, "");
    if (waited == Status::kOk) return waited;
    why_ = refusal;
  }
  return status;
}

Status UrHal::power_on() {
  const UrSettings& set = *settings_;
  const auto reached = [this](RobotMode mode) {
    return state_.robot_mode >= static_cast<int>(mode);
  };
  TRY(dashboard_.connect(set.address.c_str(), set.dashboard_port, set.connect_ms, why_));
  TRY(dashboard_.ask("power on", "Powering on", why_));
  TRY(await([&] { return reached(RobotMode::kIdle); }, set.power_ms, "power on"));
  TRY(dashboard_.ask("brake release", "Brake releasing", why_));
  return await([&] { return reached(RobotMode::kRunning); }, set.power_ms, "brake release");
}

/// Ours may be about to end. Another one is its owner's.
Status UrHal::stop_other_program() {
  const auto stopped = [this] {
    return state_.runtime_state == static_cast<std::uint32_t>(RuntimeState::kStopped);
  };
  if (stopped()) return Status::kOk;
  return await(stopped, settings_->program_ms, "end of the program on the robot");
}

/// An arm that still slows down would be stopped suddenly by a program that does not go on with it,
/// and that is a protective stop.
Status UrHal::come_to_rest() {
  constexpr double kAtRest_rad_s = 0.01;
  const auto at_rest = [this] { return state_.dq.cwiseAbs().maxCoeff() < kAtRest_rad_s; };
  return await(at_rest, settings_->program_ms, "standstill of the arm");
}

/// The register is at zero before the program looks at it, which takes a few cycles.
Status UrHal::upload_program() {
  const UrSettings& set = *settings_;
  ServoScript script;
  script.tcp.head<3>() = tool_.tip.p;
  script.payload_kg = tool_.mass_kg;
  script.payload_com = tool_.com;
  script.zero_force = set.zero_force == ZeroForce::kOn;
  script.period_s = period_us_ * 1e-6;
  script.lookahead_s = set.lookahead_s;
  script.gain = set.gain;
  script.patience = set.patience;
  script.deceleration = set.deceleration;
  const std::string_view text = write_servo_script(script, script_text_);
  if (text.empty()) return why_ = Message("the program's settings"), Status::kBadValue;

  constexpr int kSettling = 5;  // packets
  if (session_.send(0, state_.q) != Socket::Sent::kAll)
    return why_ = Message("RTDE: the registers cannot be written"), Status::kConnectionLost;
  for (int i = 0; i < kSettling; ++i) TRY(next_state());
  TRY(robot_.upload(text, set.connect_ms, why_));
  Status modes = Status::kOk;
  const auto runs_or_never_will = [&] {
    modes = judge_modes(state_, why_);
    return modes != Status::kOk || !robot_.exception().empty() ||
           (state_.playing() && state_.echo == 0);
  };
  TRY(await(runs_or_never_will, set.program_ms, "start of the program on the robot"));
  if (modes != Status::kOk || robot_.exception().empty()) return modes;
  why_ = Message("the robot does not run the program: ");
  why_ << robot_.exception();
  return Status::kRefusedByRobot;
}

}  // namespace tactus::ur
