// A host that is made of files: a tree of /proc and /sys in a folder of its own, all of it in order
// until a test breaks something.
#pragma once

#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "hal/os/host.hpp"
#include "tests/testing.hpp"

namespace tactus {

struct HostFile {
  const char* item;  ///< of the report
  const char* path;
  const char* ok;  ///< what stands there on a host that is in order
  const char* hurts;
  const char* value;  ///< what the report then shows
};

#define CPUS "/sys/devices/system/cpu/"
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
    {"machine", "/proc/cpuinfo", "processor\t: 0\nflags\t\t: fpu vme\n",
     "processor\t: 0\nflags\t\t: fpu vme hypervisor lahf_lm\n", "virtual"},
};
#undef CPUS

class HostTree {
 public:
  /// Every item in order.
  HostTree() {
    assert_non_null(mkdtemp(root_));
    for (const HostFile& file : kHostFiles)
      if (*file.ok != '\0') put(file.path, file.ok);
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

 private:
  char root_[24] = "/tmp/tactus-host-XXXXXX";
};

}  // namespace tactus
