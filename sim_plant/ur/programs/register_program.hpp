// RegisterProgram: the program of ur_rtde. It communicates only through RTDE's registers: the
// client writes a command into the first integer, the program answers ready or done in its own.
//
// Differences between versions are read from its text: where the registers begin, how progress is
// reported, and whether a function is called that only some controllers have.
#pragma once

#include "sim_plant/ur/parts/machine.hpp"
#include "sim_plant/ur/programs/async_progress.hpp"
#include "sim_plant/ur/programs/program_step.hpp"

namespace tactus::ur {

class RegisterProgram {
 public:
  static bool recognises(std::string_view text);
  /// Starts the program; the text must outlive it.
  void start(std::string_view text);

  ProgramStep poll(Machine& machine);
  ProgramStep command(Machine& machine);

 private:
  enum class Cyclic : std::uint8_t { kNone, kServo, kServoC, kSpeedJ, kSpeedL };
  enum class Outcome : std::uint8_t {
    kDone,
    kMoves,  ///< done when the arm is at rest
    kEnded,  ///< done, and the program ends
  };
  /// The answer that the client sees while the command is in its register.
  enum class Handshake : std::uint8_t {
    kDone,   ///< the command acts once
    kReady,  ///< it acts in every cycle
    kBoth,   ///< it acts in every cycle; done is visible for one cycle, for clients that wait
  };
  struct Row {
    RegisterCommand command;
    Handshake shake;
    Outcome (RegisterProgram::*act)(Machine&);  ///< null: not emulated, or of no use
    std::string_view needs;                     ///< a call; without it in the text nothing is done
  };
  static const Row kRows[];
  static const Row& row_of(RegisterCommand command);

  // register_program.cpp: the handshake.
  Outcome process(RegisterCommand command, Machine& machine);
  bool has(std::string_view part) const { return text_.find(part) != std::string_view::npos; }
  double input(int i, const Machine& machine) const;
  std::int32_t integer_input(int i, const Machine& machine) const;
  Vector6 six(int first, const Machine& machine) const;
  void write(int i, std::int32_t value, Machine& machine) const;
  void tell_progress(std::int32_t value, Machine& machine);
  void end_async(Machine& machine);

  // register_commands.cpp: the rows, and the commands that set something.
  Outcome zero_force(Machine& machine);
  Outcome set_payload(Machine& machine);
  Outcome set_tcp(Machine& machine);
  Outcome teach_mode(Machine& machine);
  Outcome end_teach_mode(Machine& machine);
  Outcome protective_stop(Machine& machine);
  Outcome set_watchdog(Machine& machine);

  // register_motion.cpp: commands that move the arm.
  Outcome move_j(Machine& machine);
  Outcome move_j_pose(Machine& machine);
  Outcome move_l(Machine& machine);
  Outcome move_l_joints(Machine& machine);
  Outcome move_path(Machine& machine);
  Outcome begin_move(bool good, Code otherwise, Machine& machine);
  Outcome begin(Machine& machine);
  void break_off(Machine& machine);
  void follow_path(Machine& machine);
  Outcome servo_j(Machine& machine);
  Outcome servo_l(Machine& machine);
  Outcome servo(const Joints& q, Machine& machine);
  Outcome servo_c(Machine& machine);
  Outcome speed_j(Machine& machine);
  Outcome speed_l(Machine& machine);
  Outcome jog_start(Machine& machine);
  Outcome jog_stop(Machine& machine);
  Outcome speed_stop(Machine& machine);
  Outcome servo_stop(Machine& machine);
  Outcome force_mode(Machine& machine);
  Outcome force_mode_stop(Machine& machine);
  Outcome stop_async(Machine& machine);
  Outcome stop(double a, Machine& machine);

  // register_answers.cpp: commands with an answer in registers.
  Outcome inverse_here(Machine& machine);
  Outcome inverse_near(Machine& machine);
  Outcome answer_inverse(const Joints& near, Machine& machine);
  Outcome has_inverse(Machine& machine);
  Outcome has_inverse_near(Machine& machine);
  Outcome joints_within(Machine& machine);
  Outcome forward_here(Machine& machine);
  Outcome forward_of(Machine& machine);
  Outcome flange_pose(Machine& machine);
  Outcome pose_trans(Machine& machine);
  Outcome tcp_offset(Machine& machine);
  Outcome joint_torques(Machine& machine);
  Outcome steady(Machine& machine);
  Outcome answer_flag(bool flag, Machine& machine) const;
  Outcome answer_six(const Vector6& values, Machine& machine) const;
  Outcome no_posture(Machine& machine) const;
  Outcome not_emulated(RegisterCommand command, Machine& machine) const;

  std::string_view text_;
  int int_offset_ = 0, double_offset_ = 0;
  bool started_ = false;
  RegisterCommand last_ = RegisterCommand::kNone;
  bool executing_ = false;  // a command was processed, and the client has not withdrawn it
  bool blocked_ = false;    // until the arm is at rest
  bool moving_ = false;     // an asynchronous motion
  AsyncProgress progress_;
  std::string_view path_;  // remaining lines of the path
  Cyclic cyclic_ = Cyclic::kNone;
  Vector6 goal_ = Vector6::Zero();
  double v_ = 0.0, a_ = 0.0, t_ = 0.0;
  ServoLaw law_;
  bool jogging_ = false;
  Frame jog_frame_;
};

}  // namespace tactus::ur
