// fer_m55: the board with a Cortex-M55 in an emulator, its plant on this computer.
#include "program/pil/pil_board.hpp"

int main(int argc, char** argv) {
  return tactus::run_pil_board(argc, argv, "fer_m55");
}
