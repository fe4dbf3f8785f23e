// ArmDrives: what is requested, what continues in any phase, and how a phase ends.
#include "hal/ur/arm_drives.hpp"

namespace tactus::ur {
namespace {

/// Packets in which set-points may be under way, beyond the patience of the program.
constexpr int kUnderWay = 10;

}  // namespace

void ArmDrives::configure(const UrSettings& settings, const Tool& given, int period_us) {
  settings_ = &settings;
  given_ = given;
  period_us_ = period_us;
}

Status ArmDrives::connect(const Deadline& deadline) {
  const UrSettings& set = *settings_;
  ServoProgram program;
  const Tool tool = assumed(given_);
  program.sets_tcp = gives_tcp(given_);
  program.sets_payload = gives_payload(given_);
  program.tcp.head<3>() = tool.tip.p;
  program.payload_kg = tool.mass_kg;
  program.payload_com = tool.com;
  program.zero_force = set.zero_force == ZeroForce::kOn;
  program.period_s = period_us_ * 1e-6;
  program.lookahead_s = set.lookahead_s;
  program.gain = set.gain;
  program.patience = set.patience;
  program.deceleration = set.deceleration;
  script_ = write_servo_program(program, text_);
  if (script_.empty()) {
    why_ = Message("[ur] or the tool of [robot]: a value is out of the program's range");
    return Status::kBadValue;
  }
  phase_ = DrivePhase::kOff;
  request_ = DriveRequest::kDisable;
  alive_ = false;
  begins_in_ = 0;
  end_sent_ = true;
  set_points_.start(set.max_missed);
  TRY(robot_.connect(set.address.c_str(), set.primary_port, deadline, why_));
  const bool asks = set.on_protective_stop == OnProtectiveStop::kRelease ||
                    set.on_power_off == OnPowerOff::kPowerOn;
  if (!asks) return Status::kOk;
  return dashboard_.connect(set.address.c_str(), set.dashboard_port, deadline, why_);
}

void ArmDrives::close() {
  robot_.close();
  dashboard_.close();
}

Status ArmDrives::compare_arm(const UrState& state) {
  if (settings_->calibration == Calibration::kAny) return Status::kOk;
  return check_calibration(robot_.calibration(), tip_distance(state), why_);
}

void ArmDrives::end_program() {
  if (end_sent_ || !session_.running()) return;
  const Message why = why_;
  bool sent = false;
  end_sent_ = set_points_.end(sent) != Status::kOk || sent;
  why_ = why;  // the earlier reason counts
}

void ArmDrives::watch(const UrState& state) {
  robot_.receive();
  if (phase_ != DrivePhase::kEnabled) return;
  Status status = judge_modes(state, why_);
  if (status == Status::kOk) status = judge_program(state, why_);
  if (status != Status::kOk) return fail(status);
  watch_echo(state);
}

/// Finds a program that uses no set-points: another one has taken the place of ours. At speed zero
/// the robot's programs may stand.
void ArmDrives::watch_echo(const UrState& state) {
  const bool stands = !(time_scaling(state.speed_scaling, state.speed_fraction) > 0.0);
  if (state.echo != echo_ || stands) unused_ = 0;
  if (state.timestamp_s != packet_s_) ++unused_;
  echo_ = state.echo;
  packet_s_ = state.timestamp_s;
  if (unused_ <= settings_->patience + kUnderWay) return;
  why_ = Message("the program on the robot has used no set-point for ");
  why_ << unused_ << " periods; another program may have taken its place";
  fail(Status::kProgramStopped);
}

Status ArmDrives::step(const RobotCommand& command, const UrState& state) {
  take(command.request);
  TRY(continue_program(state));
  if (arms(phase_)) ++cycles_;
  TRY(run_phase(command, state));
  judge_time();
  return Status::kOk;
}

/// Only a new request to arm leads out of a fault.
void ArmDrives::take(DriveRequest request) {
  const bool asked = request == DriveRequest::kArm && request_ != DriveRequest::kArm;
  const bool up = arms(phase_) || phase_ == DrivePhase::kEnabled;
  request_ = request;
  if (asked && !up) {
    robot_.forget_stop();
    why_ = Message();
    enter(DrivePhase::kModes);
  }
  if (request != DriveRequest::kDisable || !up) return;
  if (arms(phase_)) {
    why_ = Message("arming was ended while waiting for: ");
    why_ << name(phase_);
  }
  enter(alive_ ? DrivePhase::kStopping : DrivePhase::kOff);
}

/// Completes an upload in any phase, as half a program must not precede the next one, and sends the
/// command to end once to a program that is no longer needed.
Status ArmDrives::continue_program(const UrState& state) {
  const bool uploaded = robot_.uploading();
  robot_.send();
  if (begins_in_ > 0) --begins_in_;
  if (uploaded && !robot_.uploading()) begins_in_ = cycles_of(settings_->program_ms);
  if (state.playing() || !robot_.exception().empty()) begins_in_ = 0;
  alive_ = alive_ && !stopped(state);
  const bool wanted = phase_ >= DrivePhase::kUpload && phase_ <= DrivePhase::kEnabled;
  return wanted || end_sent_ ? Status::kOk : set_points_.end(end_sent_);
}

/// True if no program runs, and none of ours will begin.
bool ArmDrives::stopped(const UrState& state) const {
  return state.runtime_state == static_cast<std::uint32_t>(RuntimeState::kStopped) &&
         begins_in_ == 0 && !robot_.uploading();
}

Status ArmDrives::run_phase(const RobotCommand& command, const UrState& state) {
  if (phase_ >= DrivePhase::kOtherProgram && phase_ <= DrivePhase::kTip) {
    const Status status = judge_modes(state, why_);
    if (status != Status::kOk) fail(status);
  }
  switch (phase_) {
    case DrivePhase::kOff:
    case DrivePhase::kFault: break;
    case DrivePhase::kModes: return judge_robot(state);
    case DrivePhase::kReleaseStop: return release_stop(state);
    case DrivePhase::kPowerOn: return power_on(state);
    case DrivePhase::kReleaseBrakes: return release_brakes(state);
    case DrivePhase::kOtherProgram:
      // A program of others is not stopped.
      if (stopped(state)) enter(DrivePhase::kStandstill);
      break;
    case DrivePhase::kStandstill:
      // A program that begins while the arm slows down would stop it suddenly, which causes a
      // protective stop.
      if (state.at_rest()) compare_tool(state);
      break;
    case DrivePhase::kRegister: return clear_register(state);
    case DrivePhase::kUpload: return upload();
    case DrivePhase::kProgram: await_program(state); break;
    case DrivePhase::kFirstSetPoint: return send_first(state);
    case DrivePhase::kTip: return compare_tip(state);
    case DrivePhase::kEnabled:
      if (command.request == DriveRequest::kFollow) held_ = command.value;
      return set_points_.send(held_);
    case DrivePhase::kStopping: stop(state); break;
  }
  return Status::kOk;
}

void ArmDrives::stop(const UrState& state) {
  if (!alive_ && state.at_rest()) return enter(DrivePhase::kOff);
  if (!alive_) return;
  const Status status = judge_modes(state, why_);
  if (status != Status::kOk) fail(status);
}

void ArmDrives::judge_time() {
  if (!arms(phase_) || phase_ == DrivePhase::kModes) return;
  const int ms = phase_ < DrivePhase::kOtherProgram ? settings_->power_ms : settings_->program_ms;
  if (cycles_ < cycles_of(ms)) return;
  const PhaseTimeout timeout = timeout_of(phase_);
  why_ = Message(timeout.problem);
  why_ << " within " << ms << " ms" << timeout.remedy;
  const std::string_view refusal = dashboard_.refusal();
  if (phase_ < DrivePhase::kOtherProgram && !refusal.empty())
    why_ << "; the robot answered '" << refusal << "'";
  fail(Status::kRefusedByRobot);
}

void ArmDrives::enter(DrivePhase phase) {
  phase_ = phase;
  cycles_ = 0;
  unused_ = 0;
}

void ArmDrives::fail(Status reason) {
  reason_ = reason;
  enter(DrivePhase::kFault);
}

bool ArmDrives::stopped_by_robot() const {
  const bool reported = reason_ == Status::kDriveFault ||
                        (reason_ >= Status::kRobotMode && reason_ <= Status::kProgramStopped);
  return phase_ == DrivePhase::kFault && reported;
}

Drive ArmDrives::drive() const {
  Drive drive = {state_of(phase_), true};
  if (phase_ != DrivePhase::kFault) return drive;
  drive.reason = reason_;
  drive.code = stopped_by_robot() ? robot_.stop_code() : 0;
  return drive;
}

}  // namespace tactus::ur
