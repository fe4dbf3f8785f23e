// UrHal: a Universal Robots arm with six joints behind its own ports. State and set-points go
// through RTDE, a program of ours on the controller hands the set-points to servoj, the dashboard
// switches on and the primary port says why the robot stopped.
//
// The robot's clock is the master: the board calls wait() and then runs a cycle. What is wrong is
// found in read(), in the cycle of the packet that shows it, and stays until the next start. stop()
// lets the robot brake by itself and leaves power and brakes as they are: nothing moves without the
// program, and only a start uploads it.
#pragma once

#include "hal/ur/dashboard_client.hpp"
#include "hal/ur/packet_clock.hpp"
#include "hal/ur/robot_port.hpp"
#include "hal/ur/rtde_client.hpp"
#include "hal/ur/servo_script.hpp"
#include "hal/ur/ur_settings.hpp"
#include "kernel/hal.hpp"

namespace tactus::ur {

class UrHal final : public Hal {
 public:
  /// What the pipeline file says; must outlive the Hal's use. [init]
  void configure(const UrSettings& settings, const Tool& tool, int period_us) {
    settings_ = &settings;
    tool_ = tool;
    period_us_ = period_us;
  }

  /// Positions, at 125 Hz (CB3, e-Series) or 500 Hz (e-Series).
  Capabilities capabilities() const override;
  /// Connects, switches on where that is asked for, uploads the program and waits until it runs.
  /// kNotOffered, kConnectionLost, kBusTimeout, kRefusedByRobot, kRegistersInUse, kWireFormat, or
  /// why the robot may not move; trouble() says more. [init]
  Status start(CommandMode mode, RobotState& state) override;
  /// Asks the robot alone where it is: no registers, no program. [init]
  Status look(RobotState& state);
  Status read(RobotState& state) override;
  Status write(const RobotCommand& command) override;
  void stop() override;

  /// Waits until the next cycle begins: for the robot's packet, or until it is too late for it.
  /// Returns the stamp, ns of the robot's clock. [between two cycles]
  std::int64_t wait();

  /// What the last Status that was not kOk was about, with the robot's own code and text if it has
  /// sent any; waits for that, 0.2 s at most. [between two cycles]
  Message trouble();
  const UrState& state() const { return state_; }
  /// The count of the last set-point, as the register has it. [any]
  std::int32_t set_points() const { return count_; }
  const RtdeClient& session() const { return session_; }

 private:
  enum class Came : std::uint8_t { kNothing, kCycle, kNothingNew };

  Status attach();
  Status check_settings();
  Status prepare();
  Status release_stop();
  Status power_on();
  Status stop_other_program();
  Status come_to_rest();
  Status upload_program();
  Status next_state();
  template <class Done>
  Status await(Done done, int timeout_ms, const char* what);

  Came receive();
  Status judge_program();
  void show(RobotState& state) const;
  void close();

  const UrSettings* settings_ = nullptr;
  Tool tool_;
  int period_us_ = 0;

  RtdeClient session_;
  RobotPort robot_;
  DashboardClient dashboard_;
  ServoScriptText script_text_;
  UrState state_;
  PacketClock clock_;
  std::int32_t count_ = 0;  // of set-points; 0: none yet
  int unsent_ = 0;          // set-points in a row that could not be sent
  Status fault_ = Status::kNotStarted;
  Message why_;
};

}  // namespace tactus::ur
