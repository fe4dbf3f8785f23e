// The program of every simulated board: the robot it is built for, in virtual time.
#pragma once

namespace tactus {

/// Owns every object of the board, as statics; nothing is allocated after them. Returns the exit
/// code of the program.
int run_sim_board(int argc, char** argv, const char* board);

}  // namespace tactus
