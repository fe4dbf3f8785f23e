// A host that is made of files: a tree of /proc and /sys in a folder of its own, all of it in order
// until a test breaks something.
#pragma once

#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "hal/os/host.hpp"
#include "tests/support/testing.hpp"

namespace tactus {

struct HostFile {
  const char* item;  ///< of the report
  const char* path;
  const char* ok;  ///< what stands there on a host that is in order
  const char* hurts;
  const char* value;  ///< what the report then shows
};

#define CPUS "/sys/devices/system/cpu/"
#define GROUPS "/sys/fs/cgroup/"
/// For each item the file that decides it, seen from CPU 2.
inline constexpr HostFile kHostFiles[] = {
    {"kernel", "/proc/sys/kernel/version", "#1 SMP PREEMPT_RT Debian 6.1.192-2\n",
     "#1 SMP PREEMPT_DYNAMIC Debian 6.1.192-2\n", "PREEMPT_DYNAMIC"},
    {"priority", "/proc/self/limits",
     "Limit                     Soft Limit           Hard Limit           Units     \n"
     "Max locked memory         unlimited            unlimited            bytes     \n"
     "Max realtime priority     98                   98                   \n",
     "Max locked memory         unlimited            unlimited            bytes     \n"
     "Max realtime priority     79                   98                   \n",
     "RLIMIT_RTPRIO 79, wanted 80"},
    {"memory lock", "/proc/self/limits", "",
     "Max locked memory         8388608              unlimited            bytes     \n"
     "Max realtime priority     80                   80                   \n",
     "RLIMIT_MEMLOCK 8388608"},
    {"clock source", "/sys/devices/system/clocksource/clocksource0/current_clocksource", "tsc\n",
     "hpet\n", "hpet"},
    {"governor", CPUS "cpu2/cpufreq/scaling_governor", "performance\n", "powersave\n",
     "cpu2 powersave"},
    {"isolated CPUs", CPUS "isolated", "2-3\n", "0-1,3\n", "0-1,3"},
    {"nohz_full", CPUS "nohz_full", "1-2\n", "(null)\n", "none"},
    {"interrupts", "/proc/irq/24/smp_affinity_list", "0-1,3\n", "0-3\n", "1 of 1 on cpu2: 24"},
    {"throttling", "/proc/sys/kernel/sched_rt_runtime_us", "-1\n", "950000\n", "950000"},
    {"swap", "/proc/swaps", "Filename\t\tType\t\tSize\n",
     "Filename\t\tType\t\tSize\n/dev/sda2                  partition\t999420\n", "/dev/sda2"},
    {"SMT", CPUS "cpu2/topology/thread_siblings_list", "2\n", "2,6\n", "2,6"},
    {"huge pages", "/sys/kernel/mm/transparent_hugepage/enabled", "always [madvise] never\n",
     "[always] madvise never\n", "[always]"},
    {"timer migration", "/proc/sys/kernel/timer_migration", "0\n", "1\n", "timer_migration 1"},
    {"NMI watchdog", "/proc/sys/kernel/nmi_watchdog", "0\n", "1\n", "nmi_watchdog 1"},
    {"CPU quota", GROUPS "cpu/arm/cpu.cfs_quota_us", "-1\n", "50000\n",
     "cpu.cfs_quota_us 50000 of /sys/fs/cgroup/cpu/arm"},
    {"real-time quota", GROUPS "cpu/arm/cpu.rt_runtime_us", "1000000\n", "0\n",
     "cpu.rt_runtime_us 0 of /sys/fs/cgroup/cpu/arm"},
    {"cpuset", GROUPS "arm/cpuset.cpus.effective", "0-3\n", "0-1,3\n",
     "cpuset.cpus.effective 0-1,3 of /sys/fs/cgroup/arm"},
    {"machine", "/proc/cpuinfo", "processor\t: 0\nflags\t\t: fpu vme\n",
     "processor\t: 0\nflags\t\t: fpu vme hypervisor lahf_lm\n", "virtual"},
};
#undef GROUPS
#undef CPUS
/// Files that say where others are.
inline constexpr const char* kGroupFiles[][2] = {
    {"/proc/self/cgroup", "4:cpu,cpuacct:/arm\n1:name=systemd:/arm\n0::/arm\n"},
    {"/sys/fs/cgroup/cpu/arm/cpu.rt_period_us", "1000000\n"},
};

class HostTree {
 public:
  /// Every item in order.
  HostTree() {
    assert_non_null(mkdtemp(root_));
    for (const HostFile& file : kHostFiles)
      if (*file.ok != '\0') put(file.path, file.ok);
    for (const auto& [path, text] : kGroupFiles) put(path, text);
  }
  void put(const char* path, const char* text) {
    Text<511> whole(root_);
    whole << path;
    for (std::size_t i = sizeof root_; whole.c_str()[i] != '\0'; ++i)
      if (whole.c_str()[i] == '/')
        mkdir(Text<511>(std::string_view(whole).substr(0, i)).c_str(), 0777);
    std::FILE* file = std::fopen(whole.c_str(), "wb");
    assert_non_null(file);
    std::fputs(text, file);
    std::fclose(file);
  }
  void remove(const char* path) { unlink((Text<511>(root_) << path).c_str()); }
  void remove_all() const {
    assert_int_equal(std::system((Text<511>("rm -r ") << root_).c_str()), 0);
  }
  const char* root() const { return root_; }
  /// Asserts finding and value of the item called `name` on the host that is asked about.
  static void expect(const HostQuery& query, const char* name, HostFinding finding,
                     std::string_view value) {
    const HostReport report = inspect_host(query);
    for (const HostItem& item : report.items) {
      if (item.name != std::string_view(name)) continue;
      const bool good = item.finding == finding && std::string_view(item.value) == value;
      if (!good) print_error("%s: %s, %s\n", name, tactus::name(item.finding), item.value.c_str());
      assert_true(good);
      return;
    }
    _fail(__FILE__, __LINE__);
  }

 private:
  char root_[24] = "/tmp/tactus-host-XXXXXX";
};

}  // namespace tactus
