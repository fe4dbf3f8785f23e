// The command line of the emulated drives, as a plain struct. Only options.cpp includes CLI11,
// which needs exceptions.
#pragma once

#include "sim_plant/drives/server/arm_options.hpp"

namespace tactus::drives {

struct DrivesOptions : ArmOptions {
  struct Bus {
    char interface[16] = "";  ///< "": `descriptor` instead
    int descriptor = -1;      ///< an open socket that carries frames as packets
    int nodes[kJoints] = {};
    int count = 0;
  };
  Bus buses[kJoints];
  int bus_count = 0;
  bool fd = false;
  bool start = false;  ///< by themselves (CiA 302-2)
  bool eds = false;    ///< print the electronic data sheet and end
};

/// Reads the command line. False: the program must end with `exit_code`, because help was requested
/// or an option is wrong.
bool parse_drives_options(int argc, char** argv, DrivesOptions& options, int& exit_code);

}  // namespace tactus::drives
