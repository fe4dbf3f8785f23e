#include "sim_plant/drives/server/options.hpp"

#include "sim_plant/drives/fault_kinds.hpp"
#include "sim_plant/drives/server/arm_parser.hpp"

namespace tactus::drives {
namespace {

constexpr int kMaxNode = 127;

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
                 DrivesOptions& options) {
  std::string wrong;
  for (const std::string& bus : buses)
    if (wrong.empty()) wrong = parse_bus(bus, false, options);
  for (const std::string& bus : descriptors)
    if (wrong.empty()) wrong = parse_bus(bus, true, options);
  if (!wrong.empty() || options.bus_count > 0 || options.eds) return wrong;
  return "name at least one bus: --bus can0:1-7";
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
  std::vector<std::string> buses, descriptors;
  ArmParser parser(options);
  CLI::App app{"Emulated CiA 402 drives of a Franka FER on CAN buses", "fer_drives"};
  app.add_option("--bus", buses, "interface and its nodes, like can0:1,2,3 or can0:1-7; repeatable")
      ->take_all();
  app.add_option("--descriptor", descriptors,
                 "an open socket that carries CAN frames as packets, and its nodes, like 3:1-7")
      ->take_all();
  app.add_flag("--eds", options.eds, "print the drives' electronic data sheet (CiA 306) and end");
  app.add_flag("--fd", options.fd, "CAN FD: PDOs of up to 64 bytes");
  app.add_flag("--self-starting", options.start,
               "the drives are operational after boot-up (CiA 302-2)");
  parser.add_arm(app);
  parser.add_faults_and_duration(app, describe_faults());
  return parser.parse(app, argc, argv, exit_code,
                      [&] { return take(buses, descriptors, options); });
}

}  // namespace tactus::drives
