// fer_sim: a simulated Franka FER in virtual time.
#include "program/sim/sim_board.hpp"

int main(int argc, char** argv) {
  return tactus::run_sim_board(argc, argv, "fer_sim");
}
