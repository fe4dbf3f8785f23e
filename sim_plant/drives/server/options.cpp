#include "sim_plant/drives/server/options.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "sim_plant/drives/fault_kinds.hpp"

namespace tactus::drives {
namespace {

constexpr int kRefused = 2, kMaxNode = 127;

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

/// Reads nodes like "1,2,3" or "1-7" from `text`. Returns what is wrong with them, "" if nothing.
std::string parse_nodes(const std::string& text, DrivesOptions::Bus& bus) {
  const char* at = text.c_str();
  while (*at != '\0') {
    int first = 0, last = 0, used = 0;
    if (std::sscanf(at, "%3d-%3d%n", &first, &last, &used) != 2 || used == 0) {
      used = 0;
      if (std::sscanf(at, "%3d%n", &first, &used) != 1) return "'" + text + "' names no nodes";
      last = first;
    }
    if (first < 1 || last > kMaxNode || last < first)
      return "nodes in '" + text + "' are not from 1 to 127, or not in order";
    for (int node = first; node <= last; ++node) {
      if (bus.count == DrivesOptions::kJoints) return "'" + text + "' names more nodes than joints";
      bus.nodes[bus.count++] = node;
    }
    at += used;
    if (*at == ',')
      ++at;
    else if (*at != '\0')
      return "'" + text + "' is not a list of nodes like 1,2,3 or 1-7";
  }
  return bus.count == 0 ? "'" + text + "' names no nodes" : "";
}

/// Reads INTERFACE:NODES or DESCRIPTOR:NODES. Returns what is wrong, "" if nothing.
std::string parse_bus(const std::string& text, bool descriptor, DrivesOptions& options) {
  if (options.bus_count == DrivesOptions::kJoints) return "there are more buses than joints";
  DrivesOptions::Bus& bus = options.buses[options.bus_count++];
  const std::size_t colon = text.find(':');
  const std::string name = text.substr(0, colon);
  if (colon == std::string::npos || name.empty() || name.size() >= sizeof bus.interface)
    return "'" + text + "' is not like " + (descriptor ? "3:1-7" : "can0:1-7");
  int used = 0;
  if (!descriptor)
    std::strncpy(bus.interface, name.c_str(), sizeof bus.interface - 1);
  else if (std::sscanf(name.c_str(), "%9d%n", &bus.descriptor, &used) != 1 ||
           static_cast<std::size_t>(used) != name.size() || bus.descriptor < 0)
    return "'" + name + "' is not the number of a descriptor";
  return parse_nodes(text.substr(colon + 1), bus);
}

std::string take(const std::vector<std::string>& buses, const std::vector<std::string>& descriptors,
                 const std::vector<std::string>& faults, DrivesOptions& options) {
  std::string wrong;
  for (const std::string& bus : buses)
    if (wrong.empty()) wrong = parse_bus(bus, false, options);
  for (const std::string& bus : descriptors)
    if (wrong.empty()) wrong = parse_bus(bus, true, options);
  if (!wrong.empty()) return wrong;
  if (options.bus_count == 0 && !options.eds) return "name at least one bus: --bus can0:1-7";
  for (const std::string& fault : faults) {
    if (options.fault_count == DrivesOptions::kFaults) return "there are more than 16 faults";
    if (fault.size() >= sizeof options.faults[0]) return "the text '" + fault + "' is too long";
    std::strncpy(options.faults[options.fault_count++], fault.c_str(),
                 sizeof options.faults[0] - 1);
  }
  return "";
}

std::string describe_faults() {
  std::string text =
      "fault to inject, like \"node=3 kind=drop_tpdo at=1000 until=1010 p=0.5 value=1\", active "
      "from the SYNC `at` until before the SYNC `until`; repeatable. Kinds:";
  for (const char* name : kFaultNames) text += std::string(" ") + name;
  return text;
}

}  // namespace

bool parse_drives_options(int argc, char** argv, DrivesOptions& options, int& exit_code) {
  std::vector<std::string> buses, descriptors, faults;
  std::vector<double> q;
  CLI::App app{"Emulated CiA 402 drives of a Franka FER on CAN buses", "fer_drives"};
  app.add_option("--bus", buses, "interface and its nodes, like can0:1,2,3 or can0:1-7; repeatable")
      ->take_all();
  app.add_option("--descriptor", descriptors,
                 "an open socket that carries CAN frames as packets, and its nodes, like 3:1-7")
      ->take_all();
  app.add_flag("--eds", options.eds, "print the drives' electronic data sheet (CiA 306) and end");
  app.add_flag("--fd", options.fd, "CAN FD: PDOs of up to 64 bytes");
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
  const std::string wrong = take(buses, descriptors, faults, options);
  if (!wrong.empty()) {
    std::fprintf(stderr, "fer_drives: %s\n", wrong.c_str());
    exit_code = kRefused;
    return false;
  }
  options.joints_given = !q.empty();
  for (std::size_t i = 0; i < q.size(); ++i) options.joints[i] = q[i];
  return true;
}

}  // namespace tactus::drives
