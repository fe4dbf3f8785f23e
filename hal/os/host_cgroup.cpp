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

/// Calls `take` with the contents, the name and the folder of a file of the group, and of all
/// groups above it, from the nearest on until it returns true. Returns why there is no group, or
/// unknown.
template <class Take>
Content for_each_group(const HostQuery& query, const char* controller, const char* unified,
                       const char* legacy, Take take) {
  SmallFile groups;
  Group group;
  if (!read(query, "/proc/self/cgroup", groups)) return unreadable(groups);
  if (!find_group(groups.text(), controller, group))
    return {HostFinding::kUnknown, Text<127>("not readable: no control group")};
  const char* name = group.unified ? unified : legacy;
  Path mount(kMount);
  if (!group.unified) mount << "/" << controller;
  for (std::string_view path = group.path; *name != '\0'; path = above(path)) {
    SmallFile file;
    const Path folder = Path(mount) << path;
    const bool there = read(query, Path(folder) << "/" << name, file);
    if ((there && take(file.text(), name, folder)) || path.empty()) break;
  }
  return unreadable(0);
}

/// Judges a file of the group and of all groups above it, each by `good`. The nearest that is not
/// good decides, or else the nearest.
template <class Good>
Content judge_groups(const HostQuery& query, const char* controller, const char* unified,
                     const char* legacy, Good good) {
  Content content;
  const Content none =
      for_each_group(query, controller, unified, legacy,
                     [&](std::string_view text, const char* name, const Path& folder) {
                       const Text<127> value = Text<127>(name) << " " << text << " of " << folder;
                       const bool hurts = !good(text, folder);
                       if (hurts || content.finding == HostFinding::kUnknown)
                         content = {hurts ? HostFinding::kHurts : HostFinding::kOk, value};
                       return hurts;
                     });
  return content.finding == HostFinding::kUnknown ? none : content;
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

Content isolated_partition(const HostQuery& query) {
  SmallFile all;
  if (read(query, Path(kMount) << "/cpuset.cpus.isolated", all)) {
    const std::string_view cpus = all.text();
    if (query.cpu >= 0 ? lists_cpu(cpus, query.cpu) : !cpus.empty())
      return {HostFinding::kOk, Text<127>("cpuset.cpus.isolated ") << cpus};
  }
  Content content;
  static_cast<void>(for_each_group(
      query, "cpuset", "cpuset.cpus.partition", "",
      [&](std::string_view kind, const char* name, const Path& folder) {
        SmallFile cpus;
        if (kind == "member") return false;
        if (kind == "isolated" && read(query, Path(folder) << "/cpuset.cpus.effective", cpus) &&
            (query.cpu < 0 || lists_cpu(cpus.text(), query.cpu)))
          content = {HostFinding::kOk, Text<127>(name) << " isolated of " << folder};
        return true;
      }));
  return content;
}

}  // namespace tactus::host
