// The items of a host that are limits of the process's control group, of version 2 or 1, and of the
// groups above it. In a container the path of the group may be the host's; the groups above it then
// end at the one that the container sees.
#include "hal/os/host_items.hpp"

namespace tactus::host {
namespace {

constexpr std::string_view kMount = "/sys/fs/cgroup";

/// The group of the process under a controller.
struct Group {
  bool unified = false;  ///< version 2
  Text<511> path;        ///< below the mount, "" for the root
};

/// True if a list of words with commas between them has this one.
bool lists_word(std::string_view list, std::string_view word) {
  while (!list.empty()) {
    const std::string_view part = list.substr(0, list.find(','));
    if (part == word) return true;
    list.remove_prefix(part.size() < list.size() ? part.size() + 1 : list.size());
  }
  return false;
}

/// Finds the group in the lines "number:controllers:path" of /proc/self/cgroup; version 2 has no
/// controllers there, and version 1 goes first, as a controller can only be in one of the two.
bool find_group(std::string_view lines, std::string_view controller, Group& group) {
  bool found = false;
  while (!lines.empty()) {
    const std::string_view line = lines.substr(0, lines.find('\n'));
    lines.remove_prefix(line.size() < lines.size() ? line.size() + 1 : lines.size());
    const std::size_t first = line.find(':');
    const std::size_t second = first == line.npos ? line.npos : line.find(':', first + 1);
    if (second == line.npos) continue;
    const std::string_view controllers = line.substr(first + 1, second - first - 1);
    const bool legacy = lists_word(controllers, controller);
    if (!legacy && (!controllers.empty() || (found && !group.unified))) continue;
    const std::string_view path = line.substr(second + 1);
    group.unified = !legacy;
    group.path = path == "/" ? std::string_view() : path;
    found = true;
  }
  return found;
}

std::string_view above(std::string_view path) {
  const std::size_t slash = path.rfind('/');
  return slash == path.npos ? std::string_view() : path.substr(0, slash);
}

/// Judges a file of the group and of all groups above it, each by `good`. The nearest that is not
/// good decides, or else the nearest.
template <class Good>
Content judge_groups(const HostQuery& query, const char* controller, const char* unified,
                     const char* legacy, Good good) {
  SmallFile groups;
  Group group;
  if (!read(query, "/proc/self/cgroup", groups)) return unreadable(groups);
  if (!find_group(groups.text(), controller, group))
    return {HostFinding::kUnknown, Text<127>("not readable: no control group")};
  const char* name = group.unified ? unified : legacy;
  Path mount(kMount);
  if (!group.unified) mount << "/" << controller;
  Content content = unreadable(0);
  for (std::string_view path = group.path;; path = above(path)) {
    SmallFile file;
    const Path folder = Path(mount) << path;
    if (*name != '\0' && read(query, Path(folder) << "/" << name, file)) {
      const Text<127> value = Text<127>(name) << " " << file.text() << " of " << folder;
      if (!good(file.text(), folder)) return {HostFinding::kHurts, value};
      if (content.finding == HostFinding::kUnknown) content = {HostFinding::kOk, value};
    }
    if (path.empty()) return content;
  }
}

}  // namespace

Content cpu_quota(const HostQuery& query) {
  return judge_groups(query, "cpu", "cpu.max", "cpu.cfs_quota_us",
                      [](std::string_view quota, const Path&) {
                        return first_word(quota) == "max" || quota == "-1";
                      });
}

/// Version 2 has no such limit.
Content realtime_quota(const HostQuery& query) {
  return judge_groups(query, "cpu", "", "cpu.rt_runtime_us",
                      [&](std::string_view runtime, const Path& folder) {
                        SmallFile period;
                        if (runtime == "-1") return true;
                        if (!read(query, Path(folder) << "/cpu.rt_period_us", period)) return false;
                        const int period_us = leading_int(period.text());
                        return period_us > 0 && leading_int(runtime) >= period_us;
                      });
}

Content cpuset(const HostQuery& query) {
  if (query.cpu < 0) return {HostFinding::kUnknown, Text<127>(kNoCpu)};
  return judge_groups(
      query, "cpuset", "cpuset.cpus.effective", "cpuset.effective_cpus",
      [&](std::string_view cpus, const Path&) { return lists_cpu(cpus, query.cpu); });
}

}  // namespace tactus::host
