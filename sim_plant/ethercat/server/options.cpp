#include "sim_plant/ethercat/server/options.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "sim_plant/drives/fault_kinds.hpp"
#include "sim_plant/ethercat/line_faults.hpp"

namespace tactus::segment {
namespace {

constexpr int kRefused = 2;

/// Accepts finite numbers in range; the library also accepts "nan" and "inf".
CLI::Validator finite(double lowest, double highest) {
  return CLI::Validator(
      [lowest, highest](std::string& text) {
        char* end = nullptr;
        const double value = std::strtod(text.c_str(), &end);
        const bool good = *end == '\0' && !text.empty() && value >= lowest && value <= highest;
        return good ? std::string()
                    : "'" + text + "' is not a number from " + std::to_string(lowest) + " to " +
                          std::to_string(highest);
      },
      "");
}

std::string describe_faults() {
  std::string text =
      "fault to inject, like \"kind=counter at=1000 until=1010 value=1\" or \"node=3 "
      "kind=emergency\", "
      "active from period `at` of the arm until before period `until`; `node`: the slave, from 1; "
      "repeatable. Of the line:";
  for (const char* name : kLineFaultNames) text += std::string(" ") + name;
  return text +
         ". Of a drive: emergency switch_on_disabled wrong_mode brake_stuck sdo_abort sdo_silence "
         "wrong_identity wrong_mapping nonsense_status saturated_torque reboot";
}

std::string take(const std::string& interface, const std::vector<std::string>& faults,
                 SegmentOptions& options) {
  if (interface.empty() == (options.descriptor < 0))
    return "name one of --interface and --descriptor";
  if (interface.size() >= sizeof options.interface) return "'" + interface + "' is too long";
  std::strncpy(options.interface, interface.c_str(), sizeof options.interface - 1);
  for (const std::string& fault : faults) {
    if (options.fault_count == SegmentOptions::kFaults) return "there are more than 16 faults";
    if (fault.size() >= sizeof options.faults[0]) return "the text '" + fault + "' is too long";
    std::strncpy(options.faults[options.fault_count++], fault.c_str(),
                 sizeof options.faults[0] - 1);
  }
  return "";
}

}  // namespace

bool parse_segment_options(int argc, char** argv, SegmentOptions& options, int& exit_code) {
  std::string interface;
  std::vector<std::string> faults;
  std::vector<double> q;
  CLI::App app{"Emulated CiA 402 drives of a Franka FER on an EtherCAT segment", "fer_segment"};
  app.add_option("--interface", interface, "network interface at whose end the segment is");
  app.add_option("--descriptor", options.descriptor,
                 "instead: an open socket that carries a frame in each packet")
      ->check(CLI::Range(0, 1 << 20));
  app.add_option("--slaves", options.slaves, "slaves in the line (default 7)")
      ->check(CLI::Range(1, 7));
  app.add_option("--priority", options.priority, "SCHED_FIFO priority (default: none)")
      ->check(CLI::Range(0, 98));
  app.add_option("--joints", q, "initial positions of the seven joints, rad (default: ready pose)")
      ->expected(7)
      ->check(finite(-6.3, 6.3));
  app.add_flag("--gravity-by-drive", options.gravity_by_drive,
               "the drives compensate gravity: target torque 0 holds the arm");
  app.add_option("--friction", options.friction,
                 "multiple of the identified joint friction (default 1)")
      ->check(finite(0.0, 10.0));
  app.add_option("--rotor-inertia", options.rotor_inertia,
                 "rotor inertia at each joint, kg m^2 (default 0.1)")
      ->check(finite(0.0, 10.0));
  app.add_option("--brake-release-ms", options.brake_release_ms,
                 "time that a brake takes to open, ms (default 150)")
      ->check(finite(0.0, 10000.0));
  app.add_option("--drift-ppm", options.drift_ppm,
                 "rate of the slaves' clocks, alternately fast and slow (default 20)")
      ->check(finite(-200.0, 200.0));
  app.add_option("--fault", faults, describe_faults())->take_all();
  app.add_option("--seed", options.seed, "seed of faults by probability (default 1)");
  app.add_option("--duration", options.duration_s,
                 "time after which the program ends, s (default: never)")
      ->check(finite(0.0, 1e7));
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    exit_code = app.exit(error) == 0 ? 0 : kRefused;
    return false;
  }
  const std::string wrong = take(interface, faults, options);
  if (!wrong.empty()) {
    std::fprintf(stderr, "fer_segment: %s\n", wrong.c_str());
    exit_code = kRefused;
    return false;
  }
  options.joints_given = !q.empty();
  for (std::size_t i = 0; i < q.size(); ++i) options.joints[i] = q[i];
  return true;
}

}  // namespace tactus::segment
