// The command line of the emulated controller, as a plain struct. Only options.cpp includes CLI11,
// which needs exceptions.
#pragma once

namespace tactus::ur {

struct EmulatorOptions {
  char address[64] = "127.0.0.1";
  int port_offset = 0;     ///< added to every port
  double speed = 1.0;      ///< multiple of real time
  bool lock_step = false;  ///< a cycle begins when the clients have answered
  double start_time_s = 100.0;
  double duration_s = 0.0;    ///< by the controller's clock; 0: without end
  bool switched_off = false;  ///< POWER_OFF at the beginning
  double initial_q[6] = {0.0, -1.5708, 1.5708, -1.5708, -1.5708, 0.0};  ///< rad
  unsigned version[4] = {3, 15, 8, 106339};
  double payload[4] = {};      ///< of the pendant: kg, centre of mass in m
  double tcp[6] = {};          ///< likewise: m, rotation vector
  bool ur10e = false;          ///< reports the poses of that arm
  unsigned calibration = 0;    ///< seed of the kinematics that it reports; 0: those of its type
  bool sensor_errors = false;  ///< force and speeds are as uncertain as a robot's
  unsigned seed = 1;           ///< of these errors
  char scene[512] = "";        ///< pipeline file with what the arm carries and can touch
  char external_control_host[64] = "";
  int external_control_port = 50002;
};

/// Reads the command line. False: the program must end with `exit_code`, because help was requested
/// or an option is wrong.
bool parse_emulator_options(int argc, char** argv, EmulatorOptions& options, int& exit_code);

}  // namespace tactus::ur
