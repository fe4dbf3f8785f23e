// The program of the boards with a processor in the loop.
#pragma once

namespace tactus {

/// `board` is the folder of the board and of its image. Returns the exit code of the program.
int run_pil_board(int argc, char** argv, const char* board);

}  // namespace tactus
