// The items of a host: a function for each, which reads its files below the root of the query and
// judges what it finds. The table of all items is in host.cpp.
#pragma once

#include <dirent.h>

#include "hal/os/host.hpp"
#include "hal/os/small_file.hpp"

namespace tactus::host {

using Path = Text<511>;

/// Result of inspecting one item.
struct Content {
  HostFinding finding = HostFinding::kUnknown;
  Text<127> value;
};

inline constexpr const char* kCpus = "/sys/devices/system/cpu/";
inline constexpr const char* kNoCpu = "no CPU is chosen";

bool read(const HostQuery& query, std::string_view path, SmallFile& file);
Content judge(bool good, const Text<127>& value);
/// Unknown, with the reason of an errno if it is not 0.
Content unreadable(int error);
inline Content unreadable(const SmallFile& file) {
  return unreadable(file.error());
}
/// True if the text contains the part.
bool has(std::string_view text, std::string_view part);

/// Calls `take` with the number of every entry of the folder whose name begins with one. False: the
/// folder cannot be read.
template <class Take>
bool for_each_number(const HostQuery& query, std::string_view folder, Take take) {
  DIR* entries = opendir((Path(query.root) << folder).c_str());
  if (entries == nullptr) return false;
  for (const dirent* entry = readdir(entries); entry != nullptr; entry = readdir(entries))
    if (const int number = leading_int(entry->d_name); number >= 0) take(number);
  closedir(entries);
  return true;
}

/// Reads on which CPUs an interrupt is served, or else on which it may be.
bool read_affinity(const HostQuery& query, int interrupt, SmallFile& file);

// The kernel.
Content kernel(const HostQuery& query);
Content clock_source(const HostQuery& query);
Content throttling(const HostQuery& query);
Content swap(const HostQuery& query);
Content machine(const HostQuery& query);
Content huge_pages(const HostQuery& query);
Content timer_migration(const HostQuery& query);
Content nmi_watchdog(const HostQuery& query);

// The rights of the process.
Content priority(const HostQuery& query);
Content memory_lock(const HostQuery& query);

// Its control group.
Content cpu_quota(const HostQuery& query);
Content realtime_quota(const HostQuery& query);
Content cpuset(const HostQuery& query);
/// In order if a partition of version 2 isolates the CPU of the cycle while the host runs: the root
/// group lists those of all partitions (from Linux 6.7 on), and the nearest group of the process
/// that is a partition has its own (6.1). Unknown otherwise. Source: the kernel's
/// Documentation/admin-guide/cgroup-v2.rst, cpuset.cpus.isolated and cpuset.cpus.partition.
Content isolated_partition(const HostQuery& query);

// The CPU of the cycle.
Content governor(const HostQuery& query);
Content isolated(const HostQuery& query);
Content tickless(const HostQuery& query);
Content interrupts(const HostQuery& query);
Content siblings(const HostQuery& query);

// The network card of the robot.
Content card_priority(const HostQuery& query);
Content card_affinity(const HostQuery& query);
Content card_coalescing(const HostQuery& query);
Content busy_poll(const HostQuery& query);

}  // namespace tactus::host
