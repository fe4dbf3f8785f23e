// The program of every simulated board: runs the robot it is built for in virtual time, or by the
// wall clock.
#pragma once

namespace tactus {

/// As run_board(), for the board called `name`.
int run_sim_board(int argc, char** argv, const char* name);

}  // namespace tactus
