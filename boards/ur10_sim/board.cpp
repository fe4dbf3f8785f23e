// ur10_sim: a simulated Universal Robots UR10 (CB3) in virtual time.
#include "program/sim/sim_board.hpp"

int main(int argc, char** argv) {
  return tactus::run_sim_board(argc, argv, "ur10_sim");
}
