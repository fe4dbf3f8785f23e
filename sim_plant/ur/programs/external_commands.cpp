// The commands of external control that are not motions. They come over a socket of their own, and
// only the tool contact detection answers.
#include "sim_plant/ur/programs/external_control.hpp"

namespace tactus::ur {
namespace {

using ScriptInts = std::array<std::int32_t, kScriptCommandInts>;

constexpr std::string_view kCommandSocket = "script_command_socket";
constexpr double kContact = 0.3;  // fraction of the torque that counts as a collision
constexpr int kCommandsAtOnce = 8;
enum Contact : std::int32_t { kTouched = 0, kEndedWithout = 1 };

double value(const ScriptInts& command, std::size_t i) {
  return command[i] / kFixedPoint;
}

Vector3 three(const ScriptInts& command, std::size_t first) {
  return {value(command, first), value(command, first + 1), value(command, first + 2)};
}

Vector6 six(const ScriptInts& command, std::size_t first) {
  Vector6 values;
  values << three(command, first), three(command, first + 3);
  return values;
}

void start_force_mode(const ScriptInts& command, Machine& machine) {
  ForceMode force;
  force.task_frame = six(command, 1);
  force.selection = six(command, 7);
  force.wrench = six(command, 13);
  force.type = static_cast<int>(value(command, 19));
  force.limits = six(command, 20);
  machine.force_damping = value(command, 26);
  machine.start_force_mode(force);
}

bool touches(const Machine& machine) {
  const Joints share = machine.body.residual().cwiseAbs().cwiseQuotient(machine.settings.collision);
  return share.maxCoeff() > kContact;
}

}  // namespace

void ExternalControl::read_commands(Machine& machine) {
  Link* link = machine.links.find(kCommandSocket);
  if (link == nullptr) return;
  ScriptInts command;
  for (int n = 0; n < kCommandsAtOnce && link->read_ints(command.data(), command.size()); ++n)
    obey_command(command, *link, machine);
  const bool watches = tool_contact_ && mode_ != ControlMode::kToolInContact;
  if (!watches || trajectory_.clearing() || !touches(machine)) return;
  trajectory_.drop(machine);
  machine.freedrive = false;
  machine.motion.stop_j(kStopDeceleration);
  mode_ = ControlMode::kToolInContact;
  link->send_int(kTouched);
}

void ExternalControl::obey_command(const ScriptInts& command, Link& link, Machine& machine) {
  switch (static_cast<ScriptCommand>(command[0])) {
    case ScriptCommand::kSetTargetPayload:
    case ScriptCommand::kSetPayload:
      return machine.set_payload(value(command, 1), three(command, 2));
    case ScriptCommand::kSetToolVoltage:
      machine.io.tool_voltage = static_cast<std::int32_t>(value(command, 1));
      return;
    case ScriptCommand::kStartForceMode: return start_force_mode(command, machine);
    case ScriptCommand::kEndForceMode: machine.force_mode = {}; return;
    case ScriptCommand::kStartToolContact: tool_contact_ = true; return;
    case ScriptCommand::kEndToolContact:
      if (mode_ != ControlMode::kToolInContact) link.send_int(kEndedWithout);
      tool_contact_ = false;
      return;
    case ScriptCommand::kSetTcpOffset: return machine.set_tcp(six(command, 1));
    default: return;  // of the e-Series, or without effect on a stiff arm
  }
}

}  // namespace tactus::ur
