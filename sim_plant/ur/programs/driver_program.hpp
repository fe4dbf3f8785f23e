// DriverProgram: the program of the 2015 ROS driver. It connects to the control computer and reads
// seven integers at a time: joint positions and keep-alive. Without a new set-point it brakes but
// goes on running, even if the connection is lost; a keep-alive of zero ends it after 0.1 s.
#pragma once

#include "sim_plant/ur/parts/machine.hpp"
#include "sim_plant/ur/programs/program_step.hpp"
#include "sim_plant/ur/programs/servo_script.hpp"

namespace tactus::ur {

class DriverProgram {
 public:
  static bool recognises(std::string_view text);
  void start(std::string_view text);

  ProgramStep poll(Machine& machine);
  ProgramStep command(Machine& machine);

 private:
  SocketPlace place_;
  ServoLaw law_;
  bool wanted_ = false, fresh_ = false, moving_ = false, ending_ = false;
  double end_s_ = 0.0;
  Joints q_ = Joints::Zero();
};

}  // namespace tactus::ur
