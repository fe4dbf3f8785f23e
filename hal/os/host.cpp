#include "hal/os/host.hpp"

#include <dirent.h>

#include <algorithm>

#include "hal/os/small_file.hpp"

namespace tactus {
namespace {

using Path = Text<511>;

/// What a look at one item brought.
struct Found {
  Finding finding = Finding::kUnknown;
  Text<127> value;
};

constexpr const char* kCpus = "/sys/devices/system/cpu/";
constexpr int kMaxCpus = 1024;

bool read(const HostQuery& query, std::string_view path, SmallFile& file) {
  return file.read((Path(query.root) << path).c_str());
}

Found unreadable(const char* path) {
  return {Finding::kUnknown, Text<127>(path) << " cannot be read"};
}

Found judge(bool good, const Text<127>& value) {
  return {good ? Finding::kOk : Finding::kHurts, value};
}

bool has(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

Found kernel(const HostQuery& query) {
  SmallFile realtime, release;
  if (!read(query, "/proc/sys/kernel/version", release))
    return unreadable("/proc/sys/kernel/version");
  const bool marked = read(query, "/sys/kernel/realtime", realtime) && realtime.text() == "1";
  return judge(marked || has(release.text(), "PREEMPT_RT"), release.text());
}

/// Whether the process has the capability with this number, whatever its limits.
bool capable(const HostQuery& query, int capability) {
  SmallFile status;
  if (!read(query, "/proc/self/status", status)) return false;
  const std::string_view mask = status.line("CapEff:");  // hexadecimal, the lowest digit last
  const std::size_t digit = static_cast<std::size_t>(capability) / 4;
  if (digit >= mask.size()) return false;
  constexpr std::string_view kDigits = "0123456789abcdef";
  const std::size_t value = kDigits.find(mask[mask.size() - 1 - digit]);
  return value != std::string_view::npos && ((value >> (capability % 4)) & 1U) != 0;
}

Found priority(const HostQuery& query) {
  constexpr int kSysNice = 23;  // CAP_SYS_NICE, linux/capability.h
  SmallFile limits;
  if (capable(query, kSysNice)) return {Finding::kOk, Text<127>("CAP_SYS_NICE")};
  if (!read(query, "/proc/self/limits", limits)) return unreadable("/proc/self/limits");
  const std::string_view limit = first_word(limits.line("Max realtime priority"));
  if (limit.empty()) return unreadable("RLIMIT_RTPRIO");
  return judge(limit == "unlimited" || leading_int(limit) >= query.priority,
               Text<127>("RLIMIT_RTPRIO ") << limit << ", wanted " << query.priority);
}

Found memory_lock(const HostQuery& query) {
  constexpr int kIpcLock = 14;  // CAP_IPC_LOCK
  SmallFile limits;
  if (capable(query, kIpcLock)) return {Finding::kOk, Text<127>("CAP_IPC_LOCK")};
  if (!read(query, "/proc/self/limits", limits)) return unreadable("/proc/self/limits");
  const std::string_view limit = first_word(limits.line("Max locked memory"));
  if (limit.empty()) return unreadable("RLIMIT_MEMLOCK");
  return judge(limit == "unlimited", Text<127>("RLIMIT_MEMLOCK ") << limit);
}

Found clock_source(const HostQuery& query) {
  constexpr const char* kPath = "/sys/devices/system/clocksource/clocksource0/current_clocksource";
  SmallFile file;
  if (!read(query, kPath, file)) return unreadable("current_clocksource");
  const std::string_view source = file.text();
  // The others are read through the bus or a trap, at a microsecond or more each.
  const bool fast = source == "tsc" || source == "arch_sys_counter" || source == "kvm-clock";
  return judge(fast, source);
}

Found governor(const HostQuery& query) {
  bool any = false;
  const int first = std::max(query.cpu, 0), last = query.cpu >= 0 ? query.cpu : kMaxCpus - 1;
  for (int cpu = first; cpu <= last; ++cpu) {
    SmallFile file;
    if (!read(query, Path(kCpus) << "cpu" << cpu << "/cpufreq/scaling_governor", file)) continue;
    any = true;
    if (file.text() != "performance")
      return {Finding::kHurts, Text<127>("cpu") << cpu << " " << file.text()};
  }
  if (!any) return unreadable("cpufreq/scaling_governor");
  return {Finding::kOk, Text<127>("performance")};
}

/// A list of CPUs on which the one of the cycle should stand.
Found reserved(const HostQuery& query, const char* list) {
  SmallFile file;
  if (!read(query, Path(kCpus) << list, file)) return unreadable(list);
  const std::string_view cpus = file.text();
  const bool none = cpus.empty() || cpus == "(null)";
  return judge(query.cpu >= 0 ? lists_cpu(cpus, query.cpu) : !none,
               Text<127>(none ? "none" : cpus));
}

Found isolated(const HostQuery& query) {
  return reserved(query, "isolated");
}
Found tickless(const HostQuery& query) {
  return reserved(query, "nohz_full");
}

/// Counts the interrupts that may be served by the cycle's CPU and names the first of them.
Found interrupts(const HostQuery& query) {
  if (query.cpu < 0) return {Finding::kUnknown, Text<127>("no CPU is chosen")};
  DIR* folder = opendir((Path(query.root) << "/proc/irq").c_str());
  if (folder == nullptr) return unreadable("/proc/irq");
  int readable = 0, here = 0;
  Text<127> names;
  for (const dirent* entry = readdir(folder); entry != nullptr; entry = readdir(folder)) {
    if (leading_int(entry->d_name) < 0) continue;
    const Path path = Path("/proc/irq/") << entry->d_name;
    SmallFile file;
    if (!(read(query, Path(path) << "/effective_affinity_list", file) && !file.text().empty()) &&
        !read(query, Path(path) << "/smp_affinity_list", file))
      continue;
    ++readable;
    if (!lists_cpu(file.text(), query.cpu)) continue;
    if (++here <= 8) names << " " << entry->d_name;
  }
  closedir(folder);
  if (readable == 0) return unreadable("/proc/irq/*/smp_affinity_list");
  if (here > 8) names << " ...";
  Text<127> value;
  value << here << " of " << readable << " on cpu" << query.cpu;
  if (here > 0) value << ":" << names;
  return judge(here == 0, value);
}

Found throttling(const HostQuery& query) {
  SmallFile file;
  if (!read(query, "/proc/sys/kernel/sched_rt_runtime_us", file))
    return unreadable("sched_rt_runtime_us");
  return judge(file.text() == "-1", Text<127>("sched_rt_runtime_us ") << file.text());
}

Found swap(const HostQuery& query) {
  SmallFile file;
  if (!read(query, "/proc/swaps", file)) return unreadable("/proc/swaps");
  const std::size_t header = file.text().find('\n');  // a line of titles, then a line for each
  if (header == std::string_view::npos) return {Finding::kOk, Text<127>("none")};
  return {Finding::kHurts, Text<127>(first_word(file.text().substr(header + 1)))};
}

Found siblings(const HostQuery& query) {
  SmallFile file;
  if (query.cpu < 0) {
    if (!read(query, Path(kCpus) << "smt/active", file)) return unreadable("smt/active");
    return judge(file.text() == "0", Text<127>("smt/active ") << file.text());
  }
  const Path path = Path(kCpus) << "cpu" << query.cpu << "/topology/thread_siblings_list";
  if (!read(query, path, file)) return unreadable("thread_siblings_list");
  const Text<15> alone = Text<15>() << query.cpu;
  return judge(file.text() == std::string_view(alone), Text<127>("thread_siblings_list ")
                                                           << file.text());
}

Found machine(const HostQuery& query) {
  SmallFile cpu, vendor;
  if (!read(query, "/proc/cpuinfo", cpu)) return unreadable("/proc/cpuinfo");
  const std::string_view flags = cpu.line("flags");  // x86 only
  if (flags.empty()) return unreadable("flags of /proc/cpuinfo");
  if (!has(flags, " hypervisor")) return {Finding::kOk, Text<127>("no hypervisor")};
  Text<127> value("virtual");
  if (read(query, "/sys/class/dmi/id/sys_vendor", vendor)) value << " (" << vendor.text() << ")";
  return {Finding::kHurts, value};
}

struct Check {
  const char* name;
  bool required;
  Found (*look)(const HostQuery&);
  const char* remedy;
};

constexpr std::array<Check, 12> kChecks = {{
    {"kernel", true, kernel, "boot a PREEMPT_RT kernel (Debian: linux-image-rt-amd64)"},
    {"priority", true, priority, "limits.conf: '@realtime - rtprio 98', or CAP_SYS_NICE"},
    {"memory lock", true, memory_lock,
     "limits.conf: '@realtime - memlock unlimited', or CAP_IPC_LOCK"},
    {"clock source", true, clock_source, "boot with clocksource=tsc tsc=reliable"},
    {"governor", false, governor, "cpupower frequency-set -g performance"},
    {"isolated CPUs", false, isolated, "boot with isolcpus=N and set cpu = N"},
    {"nohz_full", false, tickless, "boot with nohz_full=N rcu_nocbs=N"},
    {"interrupts", false, interrupts,
     "name the CPU; echo the others into /proc/irq/*/smp_affinity_list; stop irqbalance"},
    {"throttling", false, throttling, "sysctl kernel.sched_rt_runtime_us=-1"},
    {"swap", false, swap, "swapoff -a"},
    {"SMT", false, siblings, "boot with nosmt, or leave the core's other CPU idle"},
    {"machine", false, machine, "run on the bare machine"},
}};

}  // namespace

bool HostReport::fit() const {
  return std::none_of(items.begin(), items.end(), [](const HostItem& item) {
    return item.required && item.finding == Finding::kHurts;
  });
}

HostReport inspect_host(const HostQuery& query) {
  HostReport report;
  for (std::size_t i = 0; i < kChecks.size(); ++i) {
    const Check& check = kChecks[i];
    const Found found = check.look(query);
    report.items[i] = {check.name, check.required, found.finding, found.value, check.remedy};
  }
  return report;
}

}  // namespace tactus
