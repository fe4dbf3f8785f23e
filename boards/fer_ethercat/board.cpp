// fer_ethercat: a Franka FER as seven CiA 402 drives on an EtherCAT segment; the computer's clock,
// in step with that of the segment, starts every cycle.
#include "boards/drive_sections.hpp"
#include "hal/ethercat/ethercat_hal.hpp"
#include "program/run_board.hpp"
#include "program/scan_segment/scan_segment.hpp"

namespace tactus {
namespace {

using Sections = DriveSections<ethercat::EthercatSettings>;

ethercat::EthercatHal hal;

Status configure(const Sections& sections, const Pipeline& pipeline, const Options&) {
  const RobotSection& robot = pipeline.robot;
  return hal.configure(sections.bus, sections.cia402, robot.tool.value, robot.mode(),
                       robot.period_us, pipeline.executive.arming_ms);
}

WireCounts counts() {
  const ethercat::LineCounts& line = hal.master().counts();
  const ethercat::Sync0Watch& sync0 = hal.master().sync0();
  WireCounts counts = {{{"frames", line.frames},
                        {"lost", line.lost},
                        {"late", line.late},
                        {"wrong_counter", line.counter},
                        {"strange", line.strange}}};
  if (!sync0.known()) return counts;
  counts[5] = {"after_sync0", sync0.without_frame()};
  counts[6] = {"clocks_apart_ns", hal.master().apart_ns()};
  counts[7] = {"before_sync0_us", sync0.least_ns() / 1000, sync0.most_ns() / 1000};
  return counts;
}

Message written(int n) {
  return hal.master().written(n);
}

Message to_home() {
  return hal.master().to_home();
}

}  // namespace
}  // namespace tactus

int main(int argc, char** argv) {
  using namespace tactus;
  return run_board<Sections>(argc, argv,
                             {"fer_ethercat", hal, sizeof hal, true, configure, scan_segment,
                              nullptr, counts, written, to_home});
}
