// The command line of tactusctl as a plain struct. Only options.cpp includes CLI11, which needs
// exceptions.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tactus::ctl {

enum class Verb : std::uint8_t {
  kSend,
  kCheck,
  kPoint,
  kStream,
  kJog,
  kCancel,
  kOverride,
  kPause,
  kResume,
  kStop,
  kRearm,
  kTare,
  kWatch,
  kRecord,
  kParams,
  kInfo,
  kRetime
};

enum Exit : int { kSucceeded = 0, kEndedOtherwise = 1, kRefused = 2, kNoConnection = 3 };

// NOLINTNEXTLINE(clang-analyzer-optin.performance.Padding): in the order of the command line
struct Options {
  Verb verb = Verb::kInfo;
  std::string connect;  ///< unix:PATH or tcp:HOST:PORT; empty: where tactus serve listens
  std::string key;      ///< file; empty: none
  std::string name;     ///< of this client, for people
  bool json = false;
  int timeout_ms = 5000;  ///< longest wait for the server
  int priority = 100;     ///< of the lease
  int lease_ms = 1000;

  std::string file;  ///< to read; "-": standard input
  std::string out;   ///< to write; "-": standard output

  // send, check, point, stream, jog
  std::string interpolation = "fields", wrap = "as_given";
  std::optional<std::string> motion_frame, wrench_frame;  ///< none: those of the pipeline
  bool exact = false, partial = false, detach = false;
  std::vector<double> numbers;  ///< of a point: joints, rad, or a pose
  bool pose = false, degrees = false, wait = false;
  double period_ms = 0.0;  ///< of a stream; 0: as the rows arrive
  double speed = 0.1;      ///< of jogging: fraction of the velocity limit
  int hold_ms = 300;       ///< time-out of a velocity
  std::string joystick;    ///< device; empty: the keyboard

  double rate = 1.0;                  ///< override
  std::vector<std::string> settings;  ///< of params: section.key=value; none: list
  bool check_only = false;

  int every_ms = 0;       ///< between two states; 0: the default of the verb
  double duration_s = 0;  ///< of watch and record; 0: until Ctrl-C
  bool trajectory = false;

  // retime
  std::string robot;  ///< empty: the one of the server
  double tolerance_rad = 0.0, tolerance_m = 0.0, radius_rad = 0.0;
  double velocity_scale = 1.0, acceleration_scale = 0.98;
  bool jerk = true;
};

/// Reads the command line. False: the program must end with `exit_code`, because help was requested
/// or an option is wrong.
bool parse_options(int argc, char** argv, Options& options, int& exit_code);

}  // namespace tactus::ctl
