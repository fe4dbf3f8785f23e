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

}  // namespace

int run_sim_board(int argc, char** argv, const char* name) {
  return run_board<SimSections>(argc, argv, {name, robot(), 0, false, configure});
}

}  // namespace tactus
