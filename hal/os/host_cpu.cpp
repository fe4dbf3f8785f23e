// The items of a host that belong to the CPU of the cycle.
#include <algorithm>

#include "hal/os/host_items.hpp"

namespace tactus::host {
namespace {

constexpr int kMaxCpus = 1024;

/// Inspects a list of CPUs that should contain the one of the cycle.
Content reserved(const HostQuery& query, const char* list) {
  SmallFile file;
  if (!read(query, Path(kCpus) << list, file)) return unreadable(file);
  const std::string_view cpus = file.text();
  const bool none = cpus.empty() || cpus == "(null)";
  return judge(query.cpu >= 0 ? lists_cpu(cpus, query.cpu) : !none,
               Text<127>(none ? "none" : cpus));
}

}  // namespace

Content governor(const HostQuery& query) {
  bool any = false;
  const int first = std::max(query.cpu, 0), last = query.cpu >= 0 ? query.cpu : kMaxCpus - 1;
  for (int cpu = first; cpu <= last; ++cpu) {
    SmallFile file;
    if (!read(query, Path(kCpus) << "cpu" << cpu << "/cpufreq/scaling_governor", file)) continue;
    any = true;
    if (file.text() != "performance")
      return {HostFinding::kHurts, Text<127>("cpu") << cpu << " " << file.text()};
  }
  if (!any) return unreadable(0);
  return {HostFinding::kOk, Text<127>("performance")};
}

Content isolated(const HostQuery& query) {
  const Content partition = isolated_partition(query);
  return partition.finding == HostFinding::kOk ? partition : reserved(query, "isolated");
}
Content tickless(const HostQuery& query) {
  return reserved(query, "nohz_full");
}

/// Counts the interrupts that the cycle's CPU may serve and names the first of them.
Content interrupts(const HostQuery& query) {
  if (query.cpu < 0) return {HostFinding::kUnknown, Text<127>(kNoCpu)};
  int readable = 0, here = 0;
  Text<127> names;
  for_each_number(query, "/proc/irq", [&](int interrupt) {
    SmallFile file;
    if (!read_affinity(query, interrupt, file)) return;
    ++readable;
    if (!lists_cpu(file.text(), query.cpu)) return;
    if (++here <= 8) names << " " << interrupt;
  });
  if (readable == 0) return unreadable(0);
  if (here > 8) names << " ...";
  Text<127> value;
  value << here << " of " << readable << " on cpu" << query.cpu;
  if (here > 0) value << ":" << names;
  return judge(here == 0, value);
}

Content siblings(const HostQuery& query) {
  SmallFile file;
  if (query.cpu < 0) {
    if (!read(query, Path(kCpus) << "smt/active", file)) return unreadable(file);
    return judge(file.text() == "0", Text<127>("smt/active ") << file.text());
  }
  const Path path = Path(kCpus) << "cpu" << query.cpu << "/topology/thread_siblings_list";
  if (!read(query, path, file)) return unreadable(file);
  const Text<15> alone = Text<15>() << query.cpu;
  return judge(file.text() == std::string_view(alone), Text<127>("thread_siblings_list ")
                                                           << file.text());
}

}  // namespace tactus::host
