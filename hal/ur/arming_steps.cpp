// ArmDrives: one step of each phase of arming.
#include "hal/ur/arm_drives.hpp"

namespace tactus::ur {

/// Decides what the robot lacks. Only people release an emergency or safeguard stop.
Status ArmDrives::judge_robot(const UrState& state) {
  if (!robot_.connected()) return lose_port();
  const Status status = judge_modes(state, why_);
  const bool releases = settings_->on_protective_stop == OnProtectiveStop::kRelease;
  const bool powers = settings_->on_power_off == OnPowerOff::kPowerOn &&
                      state.robot_mode >= static_cast<int>(RobotMode::kPowerOff) &&
                      state.robot_mode <= static_cast<int>(RobotMode::kIdle);
  attempts_ = 0;
  if (status == Status::kOk)
    enter(DrivePhase::kOtherProgram);
  else if (status == Status::kProtectiveStop && releases)
    enter(DrivePhase::kReleaseStop);
  else if (status == Status::kRobotMode && powers)
    enter(DrivePhase::kPowerOn);
  else
    fail(status);
  return Status::kOk;
}

/// Asks repeatedly, because the dashboard refuses for 5 s after the stop.
Status ArmDrives::release_stop(const UrState& state) {
  constexpr int kAttempts = 7, kBetween_ms = 1000;
  Message released;
  if (judge_modes(state, released) != Status::kProtectiveStop) {
    enter(DrivePhase::kModes);
    return Status::kOk;
  }
  const auto ask = [this] {
    ++attempts_;
    dashboard_.ask("unlock protective stop", "Protective stop releasing");
  };
  if (first_cycle()) ask();
  const DashboardClient::Answer answer = dashboard_.poll(why_);
  if (answer == DashboardClient::Answer::kLost) return dashboard_.loss();
  const bool due = cycles_ % cycles_of(kBetween_ms) == 0;
  if (answer != DashboardClient::Answer::kNo || !due) return Status::kOk;
  if (attempts_ < kAttempts)
    ask();
  else
    fail(Status::kRefusedByRobot);
  return Status::kOk;
}

Status ArmDrives::power_on(const UrState& state) {
  if (!may_get_power(state)) return Status::kOk;
  if (first_cycle()) dashboard_.ask("power on", "Powering on");
  bool yes = false;
  TRY(take_answer(yes));
  if (yes && state.robot_mode >= static_cast<int>(RobotMode::kIdle))
    enter(DrivePhase::kReleaseBrakes);
  return Status::kOk;
}

Status ArmDrives::release_brakes(const UrState& state) {
  if (!may_get_power(state)) return Status::kOk;
  if (first_cycle()) dashboard_.ask("brake release", "Brake releasing");
  bool yes = false;
  TRY(take_answer(yes));
  if (yes && state.running()) enter(DrivePhase::kModes);
  return Status::kOk;
}

/// Fails if the robot has stopped for another reason than its mode.
bool ArmDrives::may_get_power(const UrState& state) {
  const Status status = judge_modes(state, why_);
  if (status == Status::kOk || status == Status::kRobotMode) return true;
  fail(status);
  return false;
}

/// Fails if the dashboard refuses.
Status ArmDrives::take_answer(bool& yes) {
  const DashboardClient::Answer answer = dashboard_.poll(why_);
  if (answer == DashboardClient::Answer::kNo) fail(Status::kRefusedByRobot);
  yes = answer == DashboardClient::Answer::kYes;
  return answer == DashboardClient::Answer::kLost ? dashboard_.loss() : Status::kOk;
}

/// Refuses a tool or an arm that is not the one of the models, before anything is sent.
void ArmDrives::compare_tool(const UrState& state) {
  Status status = check_before_program(given_, state, settings_->tip_tolerance, why_);
  if (status == Status::kOk) status = compare_arm(state);
  if (status == Status::kOk)
    enter(DrivePhase::kRegister);
  else
    fail(status);
}

/// Waits for some packets after the register is cleared, so that the program does not see an old
/// count.
Status ArmDrives::clear_register(const UrState& state) {
  constexpr int kSettling = 5;  // packets
  if (first_cycle()) {
    cleared_ = false;
    settled_ = 0;
  }
  if (!cleared_) {
    packet_s_ = state.timestamp_s;
    return set_points_.clear(cleared_);
  }
  if (state.timestamp_s != packet_s_) ++settled_;
  packet_s_ = state.timestamp_s;
  if (settled_ >= kSettling) enter(DrivePhase::kUpload);
  return Status::kOk;
}

Status ArmDrives::upload() {
  if (first_cycle()) {
    robot_.upload(script_);
    alive_ = true;
    end_sent_ = false;
  }
  if (!robot_.connected()) return lose_port();
  if (!robot_.uploading()) enter(DrivePhase::kProgram);
  return Status::kOk;
}

void ArmDrives::await_program(const UrState& state) {
  if (!robot_.exception().empty()) {
    why_ = Message("the robot refused the program: ");
    why_ << robot_.exception();
    return fail(Status::kRefusedByRobot);
  }
  if (!state.playing() || state.echo != 0) return;
  held_ = state.q;
  enter(DrivePhase::kFirstSetPoint);
}

/// Sends the position at which the arm is held, until the program uses it.
Status ArmDrives::send_first(const UrState& state) {
  const Status status = judge_program(state, why_);
  if (status != Status::kOk) {
    fail(status);
    return Status::kOk;
  }
  TRY(set_points_.send(held_));
  if (state.echo > 0) enter(DrivePhase::kTip);
  return Status::kOk;
}

/// Compares the tip with the TCP of the program, which shows after some packets.
Status ArmDrives::compare_tip(const UrState& state) {
  constexpr int kSettling = 5;  // packets
  if (first_cycle()) settled_ = 0;
  if (state.timestamp_s != packet_s_) ++settled_;
  packet_s_ = state.timestamp_s;
  Status status = judge_program(state, why_);
  if (status != Status::kOk) {
    fail(status);
    return Status::kOk;
  }
  TRY(set_points_.send(held_));
  status = check_with_program(given_, state, settings_->tip_tolerance, why_);
  if (status == Status::kOk) {
    why_ = Message();
    enter(DrivePhase::kEnabled);
  } else if (settled_ >= kSettling) {
    fail(status);
  }
  return Status::kOk;
}

Status ArmDrives::lose_port() {
  why_ = Message("primary port: ");
  why_ << (robot_.broken() ? "a message of impossible length; check primary_port"
                           : "the connection was closed");
  return robot_.broken() ? Status::kWireFormat : Status::kConnectionLost;
}

}  // namespace tactus::ur
