// Reads the text of external control: its sockets, the parameters of its servoj, and the lines that
// releases and tests differ in.
#pragma once

#include <array>
#include <string_view>

#include "sim_plant/ur/programs/trajectory_run.hpp"

namespace tactus::ur {

struct SocketPlace {
  std::string_view host;
  int port = 0;
};

/// The sockets of external control, in the order of their connection.
inline constexpr std::array<std::string_view, 3> kExternalSockets = {
    "trajectory_socket", "script_command_socket", "reverse_socket"};

/// What a text of external control says, and in what releases and tests differ.
struct ExternalReading {
  std::array<SocketPlace, 3> places;
  ServoLaw law;  ///< of the first servoj that has one, or the default of URScript
  bool halts_when_silent = true;
  TrajectoryRun::Features features;
  std::string_view behind;  ///< the lines after the control loop
  int behind_line = 1;      ///< number of the first of them
};

/// True if the text opens the socket of set-points.
bool is_external_control(std::string_view text);
ExternalReading read_external_control(std::string_view text);

}  // namespace tactus::ur
