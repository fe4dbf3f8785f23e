// RegisterProgram: the program of ur_rtde. It talks through RTDE's registers alone: the client
// writes a command into the first integer, the program answers ready or done in its own.
#pragma once

#include "sim_plant/ur/machine.hpp"
#include "sim_plant/ur/program_step.hpp"

namespace tactus::ur {

class RegisterProgram {
 public:
  static bool recognises(std::string_view text);
  void start(std::string_view text);

  ProgramStep poll(Machine& machine);
  ProgramStep command(Machine& machine);

 private:
  enum class Cyclic : std::uint8_t { kNone, kServo, kSpeedJ, kSpeedL };

  double input(int i, const Machine& machine) const;
  std::int32_t integer(int i, const Machine& machine) const;
  Vector6 six(int first, const Machine& machine) const;
  void answer(std::int32_t value, Machine& machine) const;
  void answer_six(const Vector6& values, Machine& machine) const;
  void progress(bool running, Machine& machine);
  void process(RegisterCommand command, Machine& machine);
  void move(RegisterCommand command, Machine& machine);
  void take_cyclic(RegisterCommand command, Machine& machine);
  void stop(double a, Machine& machine);
  void ask(RegisterCommand command, Machine& machine);
  void start_force_mode(Machine& machine) const;

  int int_offset_ = 0, double_offset_ = 0;
  bool started_ = false, async_ = false;
  bool executing_ = false;  // a command was processed, and the client has not taken it back
  bool blocked_ = false;    // until the arm stands
  bool moving_ = false;     // asynchronously
  std::int32_t writes_ = 0, operations_ = 0;
  Cyclic cyclic_ = Cyclic::kNone;
  Vector6 goal_ = Vector6::Zero();
  double a_ = 0.0, t_ = 0.0;
  ServoLaw law_;
};

}  // namespace tactus::ur
