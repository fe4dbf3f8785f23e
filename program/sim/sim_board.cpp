#include "program/sim/sim_board.hpp"

#include "program/run_board.hpp"
#include "program/sim/sim_sections.hpp"
#include "sim_plant/arm/sim_hal.hpp"

namespace tactus {
namespace {

SimHal& robot() {
  static SimHal hal;
  return hal;
}

Status configure(const SimSections& sections, const Pipeline& pipeline, const Options& options) {
  robot().set_period(pipeline.robot.period_s());
  return robot().load(sections.plant.mounted_as(pipeline.robot.mounting), options.seed);
}

double servo_s(const SimSections& sections) {
  return sections.plant.servo_time_constant_s;
}

}  // namespace

int run_sim_board(int argc, char** argv, const char* name) {
  Board<SimSections> board{name, robot(), 0, false, configure};
  board.servo_s = servo_s;
  return run_board(argc, argv, board);
}

}  // namespace tactus
