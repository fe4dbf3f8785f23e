// lift6_sim: a simulated Lift6 in virtual time.
#include "program/sim/sim_board.hpp"

int main(int argc, char** argv) {
  return tactus::run_sim_board(argc, argv, "lift6_sim");
}
