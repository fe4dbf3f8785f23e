#include "sim_plant/ur/register_program.hpp"

namespace tactus::ur {

/// What is answered in registers.
void RegisterProgram::ask(RegisterCommand command, Machine& machine) {
  Joints q = six(0, machine);
  const double limit = machine.settings.motion.position;
  const auto answer_flag = [&](bool flag) {
    machine.io.output.ints[static_cast<std::size_t>(int_offset_) + 1] = flag ? 1 : 0;
  };
  switch (command) {
    case RegisterCommand::kInverseKinematics:
      if (inverse(Frame::of(six(0, machine)), machine.motion.tool(), six(6, machine), q))
        answer_six(q, machine);
      return;
    case RegisterCommand::kPoseWithinLimits:
      return answer_flag(
          inverse(Frame::of(six(0, machine)), machine.motion.tool(), machine.motion.q(), q));
    case RegisterCommand::kJointsWithinLimits:
      return answer_flag(q.cwiseAbs().maxCoeff() <= limit);
    case RegisterCommand::kJointTorques:
      return answer_six(machine.body.tau(), machine);
    default:
      return;  // not emulated: done at once
  }
}

}  // namespace tactus::ur
