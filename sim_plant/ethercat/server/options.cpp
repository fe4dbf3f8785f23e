#include "sim_plant/ethercat/server/options.hpp"

#include "sim_plant/drives/server/arm_parser.hpp"
#include "sim_plant/ethercat/line_faults.hpp"
#include "sim_plant/ethercat/sii_image.hpp"

namespace tactus::segment {
namespace {

std::string describe_faults() {
  std::string text =
      "fault to inject, like \"kind=counter at=1000 until=1010 value=1\" or \"node=3 "
      "kind=emergency\", "
      "active from period `at` of the arm until before period `until`; `node`: the slave, from 1; "
      "repeatable. Of the line:";
  for (const char* name : kLineFaultNames) text += std::string(" ") + name;
  return text +
         ". Of a drive: emergency switch_on_disabled wrong_mode brake_stuck sdo_abort sdo_silence "
         "wrong_identity wrong_mapping nonsense_status saturated_torque reboot warning "
         "homing_fails";
}

std::string take(const std::string& interface, SegmentOptions& options) {
  if (interface.empty() == (options.descriptor < 0))
    return "name one of --interface and --descriptor";
  if (interface.size() >= sizeof options.interface) return "'" + interface + "' is too long";
  std::strncpy(options.interface, interface.c_str(), sizeof options.interface - 1);
  return "";
}

}  // namespace

bool parse_segment_options(int argc, char** argv, SegmentOptions& options, int& exit_code) {
  std::string interface;
  drives::ArmParser parser(options);
  CLI::App app{"Emulated CiA 402 drives of a Franka FER on an EtherCAT segment", "fer_segment"};
  app.add_option("--interface", interface, "network interface at whose end the segment is");
  app.add_option("--descriptor", options.descriptor,
                 "instead: an open socket that carries a frame in each packet")
      ->check(CLI::Range(0, 1 << 20));
  app.add_option("--slaves", options.slaves, "slaves in the line (default 7)")
      ->check(CLI::Range(1, 7));
  app.add_option("--priority", options.priority, "SCHED_FIFO priority (default: none)")
      ->check(CLI::Range(0, 98));
  parser.add_arm(app);
  app.add_option("--drift-ppm", options.drift_ppm,
                 "rate of the slaves' clocks, alternately fast and slow (default 20)")
      ->check(finite(-200.0, 200.0));
  app.add_option("--mailbox-out", options.mailbox_out,
                 "bytes of the mailbox of requests, in the EEPROM of every slave (default 128)")
      ->check(CLI::Range(0, SmPlaces::kLongestMailbox));
  app.add_option("--mailbox-in", options.mailbox_in,
                 "bytes of the mailbox of answers (default 128)")
      ->check(CLI::Range(0, SmPlaces::kLongestMailbox));
  app.add_option("--no-lrw", options.no_lrw,
                 "the slave, from 1, that cannot read and write in one datagram (default 0: none)")
      ->check(CLI::Range(0, 7));
  app.add_option("--sync0", options.sync0,
                 "the slave, from 1, that demands SYNC0 (default 0: none)")
      ->check(CLI::Range(0, 7));
  parser.add_faults_and_duration(app, describe_faults());
  return parser.parse(app, argc, argv, exit_code, [&] { return take(interface, options); });
}

}  // namespace tactus::segment
