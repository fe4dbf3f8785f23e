// fer_can: a Franka FER as seven CiA 402 drives on CAN; the computer's clock starts every cycle.
#include "boards/drive_sections.hpp"
#include "hal/can/can_hal.hpp"
#include "program/run_board.hpp"
#include "program/scan/scan.hpp"

namespace tactus {
namespace {

using Sections = DriveSections<can::CanSettings>;

can::CanHal hal;

Status configure(const Sections& sections, const Pipeline& pipeline, const Options&) {
  const RobotSection& robot = pipeline.robot;
  return hal.configure(sections.bus, sections.cia402, robot.tool.value, robot.mode(),
                       robot.period_us, pipeline.executive.arming_ms);
}

Message to_home() {
  return hal.master().to_home();
}

Message written(int n) {
  return hal.master().written(n);
}

}  // namespace
}  // namespace tactus

int main(int argc, char** argv) {
  using namespace tactus;
  return run_board<Sections>(
      argc, argv,
      {"fer_can", hal, sizeof hal, true, configure, scan, nullptr, nullptr, written, to_home});
}
