#include "hal/os/host.hpp"

#include <algorithm>

#include "hal/os/host_items.hpp"

namespace tactus {
namespace {

struct Check {
  const char* name;
  Need need;
  host::Content (*look)(const HostQuery&);
  const char* place;
  const char* reason;
  const char* remedy;
};

constexpr std::array<Check, 22> kChecks = {{
    {"kernel", Need::kHost, host::kernel, "/proc/sys/kernel/version, /sys/kernel/realtime",
     "sections of the kernel that cannot be preempted hold the cycle up",
     "boot a PREEMPT_RT kernel (Debian: linux-image-rt-amd64)"},
    {"priority", Need::kRight, host::priority, "/proc/self/limits, /proc/self/status",
     "without SCHED_FIFO any other program holds the cycle up",
     "limits.conf: '@realtime - rtprio 98', or CAP_SYS_NICE"},
    {"memory lock", Need::kRight, host::memory_lock, "/proc/self/limits, /proc/self/status",
     "a page that is not locked may have to be read from the disk",
     "limits.conf: '@realtime - memlock unlimited', or CAP_IPC_LOCK"},
    {"clock source", Need::kHost, host::clock_source,
     "/sys/devices/system/clocksource/clocksource0/current_clocksource",
     "any other is read through the bus or a trap, which takes a microsecond or more",
     "boot with clocksource=tsc tsc=reliable"},
    {"governor", Need::kBetter, host::governor,
     "/sys/devices/system/cpu/cpu*/cpufreq/scaling_governor",
     "the CPU takes time to become fast again after each sleep",
     "cpupower frequency-set -g performance"},
    {"isolated CPUs", Need::kBetter, host::isolated,
     "/sys/devices/system/cpu/isolated, cpuset.cpus.isolated, cpuset.cpus.partition of the cgroup",
     "other programs run on the cycle's CPU and empty its caches",
     "boot with isolcpus=N, or make a cpuset partition isolated, and set cpu = N"},
    {"nohz_full", Need::kBetter, host::tickless, "/sys/devices/system/cpu/nohz_full",
     "the kernel's tick interrupts the cycle", "boot with nohz_full=N rcu_nocbs=N"},
    {"interrupts", Need::kBetter, host::interrupts, "/proc/irq/*/smp_affinity_list",
     "other devices interrupt the cycle",
     "name the CPU; echo the others into /proc/irq/*/smp_affinity_list; stop irqbalance"},
    {"throttling", Need::kBetter, host::throttling, "/proc/sys/kernel/sched_rt_runtime_us",
     "the kernel stops real-time threads that have run for that long in a second",
     "sysctl kernel.sched_rt_runtime_us=-1"},
    {"swap", Need::kBetter, host::swap, "/proc/swaps",
     "other programs wait for the disk, and the kernel works for them", "swapoff -a"},
    {"SMT", Need::kBetter, host::siblings,
     "/sys/devices/system/cpu/cpu*/topology/thread_siblings_list",
     "the other CPU of the core takes half of its units and caches",
     "boot with nosmt, or leave the core's other CPU idle"},
    {"machine", Need::kBetter, host::machine, "/proc/cpuinfo",
     "the hypervisor takes the CPU away, unseen by the kernel", "run on the bare machine"},
    {"huge pages", Need::kBetter, host::huge_pages, "/sys/kernel/mm/transparent_hugepage/enabled",
     "the kernel moves memory to join pages, and whoever touches it waits",
     "boot with transparent_hugepage=madvise"},
    {"timer migration", Need::kBetter, host::timer_migration, "/proc/sys/kernel/timer_migration",
     "timers of idle CPUs move to the busy one, which may be the cycle's",
     "sysctl kernel.timer_migration=0"},
    {"NMI watchdog", Need::kBetter, host::nmi_watchdog, "/proc/sys/kernel/nmi_watchdog",
     "its interrupt cannot be masked and comes in the middle of a cycle",
     "sysctl kernel.nmi_watchdog=0"},
    {"CPU quota", Need::kBetter, host::cpu_quota, "cpu.max or cpu.cfs_quota_us of the cgroup",
     "threads without real-time priority, the log's too, stop until the next period",
     "give the group no quota: CPUQuota= of a unit, --cpus of a container"},
    {"real-time quota", Need::kBetter, host::realtime_quota, "cpu.rt_runtime_us of the cgroup",
     "real-time threads of the group stop until the next period; 0 permits none",
     "write the period, or -1, into cpu.rt_runtime_us; version 2 has no such limit"},
    {"cpuset", Need::kRight, host::cpuset, "cpuset.cpus.effective of the cgroup",
     "the cycle cannot run on its CPU", "AllowedCPUs= of a unit, --cpuset-cpus of a container"},
    {"card priority", Need::kBetter, host::card_priority, "/proc/<irq thread>/stat",
     "packets of the robot wait for the interrupts of other devices",
     "name it with --interface; on PREEMPT_RT chrt -f -p 70 <thread>, above the 50 of all others"},
    {"card affinity", Need::kBetter, host::card_affinity, "/proc/irq/<of the card>/",
     "each packet, the others' too, interrupts the cycle",
     "name them with --interface and --cpu; echo another CPU into its smp_affinity_list; stop "
     "irqbalance"},
    {"coalescing", Need::kBetter, host::card_coalescing, "ioctl SIOCETHTOOL, as ethtool -c",
     "the card delays the interrupt of a packet to wait for more",
     "name it with --interface; ethtool -C <interface> adaptive-rx off rx-usecs 0"},
    {"busy poll", Need::kBetter, host::busy_poll, "/proc/sys/net/core/busy_poll",
     "a packet wakes the cycle by an interrupt, not by a look at the card",
     "name it with --interface; sysctl net.core.busy_poll=50, where the kernel has it"},
}};

}  // namespace

bool HostReport::fit() const {
  return std::none_of(items.begin(), items.end(), [](const HostItem& item) {
    return item.need != Need::kBetter && item.finding == HostFinding::kHurts;
  });
}

int HostReport::unknown() const {
  return static_cast<int>(std::count_if(items.begin(), items.end(), [](const HostItem& item) {
    return item.finding == HostFinding::kUnknown;
  }));
}

HostReport inspect_host(const HostQuery& query) {
  HostReport report;
  for (std::size_t i = 0; i < kChecks.size(); ++i) {
    const Check& check = kChecks[i];
    const host::Content found = check.look(query);
    report.items[i] = {check.name,  check.need,   found.finding, found.value,
                       check.place, check.reason, check.remedy};
  }
  return report;
}

}  // namespace tactus
