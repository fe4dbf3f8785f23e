// The commands of external control that come over a socket of their own and move nothing.
#include "sim_plant/ur/external_control.hpp"

namespace tactus::ur {
namespace {

enum ContactResult : std::int32_t { kContact = 0, kNoContact = 1 };

}  // namespace

void ExternalControl::read_commands(Machine& machine) {
  Link* link = machine.links.find("script_command_socket");
  std::array<std::int32_t, kScriptCommandInts> message;
  while (link != nullptr && link->read_ints(message.data(), message.size())) {
    const auto value = [&](std::size_t i) { return message[i] / kFixedPoint; };
    switch (static_cast<ScriptCommand>(message[0])) {
      case ScriptCommand::kSetPayload:
      case ScriptCommand::kSetTargetPayload:
        machine.payload = value(1);
        machine.payload_cog = Vector3(value(2), value(3), value(4));
        break;
      case ScriptCommand::kSetToolVoltage:
        machine.io.tool_voltage = static_cast<std::int32_t>(value(1));
        break;
      case ScriptCommand::kSetTcpOffset: {
        Vector6 pose;
        for (int i = 0; i < 6; ++i) pose[i] = value(static_cast<std::size_t>(i) + 1);
        machine.set_tcp(pose);
        break;
      }
      case ScriptCommand::kStartToolContact:
        tool_contact_ = true;
        break;
      case ScriptCommand::kEndToolContact:
        link->send_int(kNoContact);  // nothing is there to be touched
        tool_contact_ = false;
        break;
      default:
        break;  // forces are not controlled
    }
  }
}

}  // namespace tactus::ur
