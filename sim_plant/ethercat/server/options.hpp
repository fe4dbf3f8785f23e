// The command line of the emulated segment, as a plain struct. Only options.cpp includes CLI11,
// which needs exceptions.
#pragma once

namespace tactus::segment {

struct SegmentOptions {
  static constexpr int kJoints = 7, kFaults = 16;

  char interface[16] = "";  ///< "": `descriptor` instead
  int descriptor = -1;      ///< an open socket that carries frames as packets
  int slaves = kJoints;
  int priority = 0;  ///< of SCHED_FIFO; 0: none
  bool gravity_by_drive = false;
  bool joints_given = false;
  double joints[kJoints] = {};  ///< initial positions, rad
  double friction = 1.0;        ///< multiple of the identified friction
  double rotor_inertia = 0.1;   ///< kg m^2
  double brake_release_ms = 150.0;
  double drift_ppm = 20.0;  ///< of the clocks
  double duration_s = 0.0;  ///< 0: without end
  unsigned seed = 1;        ///< of faults by probability
  char faults[kFaults][128] = {};
  int fault_count = 0;
};

/// Reads the command line. False: the program must end with `exit_code`, because help was requested
/// or an option is wrong.
bool parse_segment_options(int argc, char** argv, SegmentOptions& options, int& exit_code);

}  // namespace tactus::segment
