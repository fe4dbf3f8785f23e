#include "hal/os/host_items.hpp"

#include <cstring>

namespace tactus::host {

bool read(const HostQuery& query, std::string_view path, SmallFile& file) {
  return file.read((Path(query.root) << path).c_str());
}

Content judge(bool good, const Text<127>& value) {
  return {good ? HostFinding::kOk : HostFinding::kHurts, value};
}

Content unreadable(int error) {
  Text<127> why("not readable");
  if (error != 0) why << ": " << std::strerror(error);
  return {HostFinding::kUnknown, why};
}

bool has(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

bool read_affinity(const HostQuery& query, int interrupt, SmallFile& file) {
  const Path folder = Path("/proc/irq/") << interrupt;
  return (read(query, Path(folder) << "/effective_affinity_list", file) && !file.text().empty()) ||
         read(query, Path(folder) << "/smp_affinity_list", file);
}

}  // namespace tactus::host
