// ExternalControl: the program of the vendor's client library. It connects to the control computer
// in the order trajectory, script command, reverse, and then executes the messages of the reverse
// socket until a stop comes, or no message comes in time.
#pragma once

#include "sim_plant/ur/programs/external_text.hpp"
#include "sim_plant/ur/programs/line_program.hpp"
#include "sim_plant/ur/programs/trajectory_run.hpp"

namespace tactus::ur {

class ExternalControl {
 public:
  /// Starts the program; the text must outlive it.
  void start(std::string_view text) {
    *this = {};
    text_ = read_external_control(text);
    trajectory_.set_features(text_.features);
  }

  ProgramStep poll(Machine& machine);
  ProgramStep command(Machine& machine);

 private:
  enum class Phase : std::uint8_t { kConnecting, kRunning, kJoining, kEnding, kBehind, kEnded };
  using Message = std::array<std::int32_t, kReverseInts>;

  ProgramStep connect(Machine& machine);
  void give_up(Machine& machine);
  void read_reverse(Machine& machine);
  void take(const Message& message, Machine& machine);
  void enter(const Message& message, Machine& machine);
  void obey(const Message& message, Machine& machine);
  void forward(const Message& message, Machine& machine);
  void read_commands(Machine& machine);
  void obey_command(const std::array<std::int32_t, kScriptCommandInts>& command, Link& link,
                    Machine& machine);
  void set_point(const Joints& q, Machine& machine);
  void leave(bool halts, Machine& machine);
  ProgramStep servo(Machine& machine);

  enum class Servo : std::uint8_t { kNone, kNew, kOld };

  ExternalReading text_;
  std::size_t connected_ = 0;
  double retry_at_s_ = 0.0;
  int attempts_ = 0;

  Phase phase_ = Phase::kConnecting;
  Servo servo_ = Servo::kNone;
  bool halts_ = false, tool_contact_ = false, warned_ = false;
  ControlMode mode_ = ControlMode::kUninitialised;
  Message waiting_{};  // waits for the old motion to end
  double timeout_s_ = 0.0, silent_s_ = 0.0, log_at_s_ = 0.0;
  Joints servo_q_ = Joints::Zero();
  Vector6 speed_ = Vector6::Zero();
  TrajectoryRun trajectory_;
  LineProgram rest_;
};

}  // namespace tactus::ur
