// ur10_socket: a Universal Robots UR10 behind its own TCP ports; its clock starts every cycle.
#include "boards/ur10_socket/ur_sections.hpp"
#include "hal/ur/ur_hal.hpp"
#include "program/run_board.hpp"

namespace tactus {
namespace {

ur::UrHal hal;

Status configure(const UrSections& sections, const Pipeline& pipeline, const Options&) {
  const RobotSection& robot = pipeline.robot;
  hal.configure(sections.ur, robot.given_tool(), robot.period_us, robot.commands_outputs());
  return Status::kOk;
}

}  // namespace
}  // namespace tactus

int main(int argc, char** argv) {
  using namespace tactus;
  return run_board<UrSections>(argc, argv, {"ur10_socket", hal, sizeof hal, true, configure});
}
