// The limits of a control group, of both versions, on hosts made of files.
#include "tests/hal/os/host_tree.hpp"

namespace tactus {
namespace {

constexpr int kCpu = 2;

/// An item of a host whose process is in these groups, and then only the files that a test plants.
class GroupTree : public HostTree {
 public:
  explicit GroupTree(const char* groups) {
    for (const char* file :
         {"/sys/fs/cgroup/cpu/arm/cpu.cfs_quota_us", "/sys/fs/cgroup/cpu/arm/cpu.rt_runtime_us",
          "/sys/fs/cgroup/arm/cpuset.cpus.effective"})
      remove(file);
    put("/proc/self/cgroup", groups);
  }
  void expect(const char* name, HostFinding finding, std::string_view value) const {
    HostTree::expect({root(), kCpu, 80}, name, finding, value);
  }
};

// Proves RT-5.

void a_quota_of_version_2_hurts_in_the_group_and_in_every_group_above(void**) {
  GroupTree tree("0::/robots.slice/arm.service\n");
  tree.expect("CPU quota", HostFinding::kUnknown, "not readable");
  tree.put("/sys/fs/cgroup/robots.slice/arm.service/cpu.max", "max 100000\n");
  tree.expect("CPU quota", HostFinding::kOk,
              "cpu.max max 100000 of /sys/fs/cgroup/robots.slice/arm.service");
  tree.put("/sys/fs/cgroup/robots.slice/cpu.max", "150000 100000\n");
  tree.expect("CPU quota", HostFinding::kHurts,
              "cpu.max 150000 100000 of /sys/fs/cgroup/robots.slice");
  tree.put("/sys/fs/cgroup/robots.slice/cpu.max", "max 100000\n");
  tree.put("/sys/fs/cgroup/robots.slice/arm.service/cpu.max", "20000 100000\n");
  tree.expect("CPU quota", HostFinding::kHurts,
              "cpu.max 20000 100000 of /sys/fs/cgroup/robots.slice/arm.service");
  tree.remove_all();
}

void a_group_that_only_the_host_sees_is_that_of_the_mount(void**) {
  GroupTree tree("3:cpuset:/docker/0a1b\n2:cpu,cpuacct:/docker/0a1b\n");
  tree.put("/sys/fs/cgroup/cpuset/cpuset.effective_cpus", "0-1\n");
  tree.put("/sys/fs/cgroup/cpu/cpu.cfs_quota_us", "-1\n");
  tree.expect("cpuset", HostFinding::kHurts, "cpuset.effective_cpus 0-1 of /sys/fs/cgroup/cpuset");
  tree.expect("CPU quota", HostFinding::kOk, "cpu.cfs_quota_us -1 of /sys/fs/cgroup/cpu");
  tree.remove_all();
}

void a_real_time_quota_is_in_order_if_it_is_the_whole_period(void**) {
  GroupTree tree("1:cpu:/\n");
  tree.put("/sys/fs/cgroup/cpu/cpu.rt_runtime_us", "950000\n");
  tree.expect("real-time quota", HostFinding::kHurts,
              "cpu.rt_runtime_us 950000 of /sys/fs/cgroup/cpu");
  tree.put("/sys/fs/cgroup/cpu/cpu.rt_period_us", "1000000\n");
  tree.expect("real-time quota", HostFinding::kHurts,
              "cpu.rt_runtime_us 950000 of /sys/fs/cgroup/cpu");
  tree.put("/sys/fs/cgroup/cpu/cpu.rt_period_us", "none\n");
  tree.expect("real-time quota", HostFinding::kHurts,
              "cpu.rt_runtime_us 950000 of /sys/fs/cgroup/cpu");
  tree.put("/sys/fs/cgroup/cpu/cpu.rt_period_us", "950000\n");
  tree.expect("real-time quota", HostFinding::kOk,
              "cpu.rt_runtime_us 950000 of /sys/fs/cgroup/cpu");
  tree.put("/sys/fs/cgroup/cpu/cpu.rt_runtime_us", "-1\n");
  tree.expect("real-time quota", HostFinding::kOk, "cpu.rt_runtime_us -1 of /sys/fs/cgroup/cpu");
  tree.put("/proc/self/cgroup", "0::/\n");
  tree.expect("real-time quota", HostFinding::kUnknown, "not readable");
  tree.remove_all();
}

/// As the kernel shows them: all that there are in the root group, and the kind of each group.
void a_cpu_of_an_isolated_partition_is_isolated(void**) {
  GroupTree tree("0::/robots.slice/arm.service\n");
  tree.put("/sys/devices/system/cpu/isolated", "\n");
  tree.expect("isolated CPUs", HostFinding::kHurts, "none");
  tree.put("/sys/fs/cgroup/cpuset.cpus.isolated", "3\n");
  tree.expect("isolated CPUs", HostFinding::kHurts, "none");
  tree.put("/sys/fs/cgroup/cpuset.cpus.isolated", "2-3\n");
  tree.expect("isolated CPUs", HostFinding::kOk, "cpuset.cpus.isolated 2-3");
  tree.remove("/sys/fs/cgroup/cpuset.cpus.isolated");
  constexpr const char *kAbove = "/sys/fs/cgroup/robots.slice/cpuset.cpus.partition",
                       *kHere = "/sys/fs/cgroup/robots.slice/arm.service/cpuset.cpus.partition";
  tree.put("/sys/fs/cgroup/robots.slice/cpuset.cpus.effective", "2-3\n");
  tree.put("/sys/fs/cgroup/robots.slice/arm.service/cpuset.cpus.effective", "2-3\n");
  tree.put(kHere, "member\n");
  for (const char* kind : {"member\n", "root\n", "isolated invalid (Cpu list is empty)\n"}) {
    tree.put(kAbove, kind);
    tree.expect("isolated CPUs", HostFinding::kHurts, "none");
  }
  tree.put(kAbove, "isolated\n");
  tree.expect("isolated CPUs", HostFinding::kOk,
              "cpuset.cpus.partition isolated of /sys/fs/cgroup/robots.slice");
  tree.put("/sys/fs/cgroup/robots.slice/cpuset.cpus.effective", "3\n");
  tree.expect("isolated CPUs", HostFinding::kHurts, "none");
  tree.put("/sys/fs/cgroup/robots.slice/cpuset.cpus.effective", "2-3\n");
  tree.put(kHere, "root\n");  // its own, with the scheduler's balance
  tree.expect("isolated CPUs", HostFinding::kHurts, "none");
  tree.remove_all();
}

void lines_that_are_none_of_the_kernel_are_left_out(void**) {
  for (const char* lines : {"", "\n", ":", "::", "cpu\n", "5:cpu\n", "5:cpux,xcpu:/\n"}) {
    GroupTree tree(lines);
    const bool unified = std::string_view(lines) == "::";
    tree.expect("CPU quota", HostFinding::kUnknown,
                unified ? "not readable" : "not readable: no control group");
    tree.remove_all();
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_quota_of_version_2_hurts_in_the_group_and_in_every_group_above),
      cmocka_unit_test(a_group_that_only_the_host_sees_is_that_of_the_mount),
      cmocka_unit_test(a_real_time_quota_is_in_order_if_it_is_the_whole_period),
      cmocka_unit_test(a_cpu_of_an_isolated_partition_is_isolated),
      cmocka_unit_test(lines_that_are_none_of_the_kernel_are_left_out),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
