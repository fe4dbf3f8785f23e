// gen3_sim: a simulated Kinova Gen3 in virtual time.
#include "program/sim/sim_board.hpp"

int main(int argc, char** argv) {
  return tactus::run_sim_board(argc, argv, "gen3_sim");
}
