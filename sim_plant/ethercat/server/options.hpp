// The command line of the emulated segment, as a plain struct. Only options.cpp includes CLI11,
// which needs exceptions.
#pragma once

#include "sim_plant/drives/server/arm_options.hpp"

namespace tactus::segment {

struct SegmentOptions : drives::ArmOptions {
  char interface[16] = "";  ///< "": `descriptor` instead
  int descriptor = -1;      ///< an open socket that carries frames as packets
  int slaves = kJoints;
  int no_lrw = 0;                           ///< the slave that does not have LRW, from 1; 0: none
  int sync0 = 0;                            ///< the slave that demands SYNC0, from 1; 0: none
  int priority = 0;                         ///< of SCHED_FIFO; 0: none
  double drift_ppm = 20.0;                  ///< of the clocks
  int mailbox_out = 128, mailbox_in = 128;  ///< bytes, of requests and of answers
};

/// Reads the command line. False: the program must end with `exit_code`, because help was requested
/// or an option is wrong.
bool parse_segment_options(int argc, char** argv, SegmentOptions& options, int& exit_code);

}  // namespace tactus::segment
