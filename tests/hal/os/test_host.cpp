// Tests the inspection of a host, on hosts made of files.
#include "hal/os/host.hpp"

#include "hal/os/small_file.hpp"
#include "tests/hal/os/host_tree.hpp"

namespace tactus {
namespace {

constexpr int kCpu = 2;
constexpr std::string_view kNoInterface = "no interface is named";

const HostItem& item_of(const HostReport& report, std::string_view name) {
  for (const HostItem& item : report.items)
    if (name == item.name) return item;
  print_error("there is no item %s\n", name.data());
  _fail(__FILE__, __LINE__);
  return report.items[0];
}

void expect(const HostTree& tree, const char* name, HostFinding finding, std::string_view value) {
  const HostReport report = inspect_host({tree.root(), kCpu, 80});
  const HostItem& item = item_of(report, name);
  const std::string_view found = item.value;
  if (item.finding != finding || found.find(value) == std::string_view::npos)
    print_error("%s: %d, %s\n", name, static_cast<int>(item.finding), item.value.c_str());
  assert_true(item.finding == finding && found.find(value) != std::string_view::npos);
}

// Proves RT-5.

void a_host_in_order_is_fit_and_every_item_is_ok(void**) {
  const HostTree tree;
  const HostReport report = inspect_host({tree.root(), kCpu, 80});
  for (const HostItem& item : report.items) {
    assert_false(item.value.empty());
    for (const char* text : {item.place, item.reason, item.remedy}) assert_true(text[0] != '\0');
    if (item.finding == HostFinding::kUnknown && std::string_view(item.value) == kNoInterface)
      continue;
    if (item.finding != HostFinding::kOk) print_error("%s: %s\n", item.name, item.value.c_str());
    assert_true(item.finding == HostFinding::kOk);
  }
  assert_true(report.fit());
  tree.remove_all();
}

void each_item_hurts_alone_when_its_file_says_so(void**) {
  for (const HostFile& file : kHostFiles) {
    HostTree tree;
    tree.put(file.path, file.hurts);
    expect(tree, file.item, HostFinding::kHurts, file.value);
    const HostReport report = inspect_host({tree.root(), kCpu, 80});
    for (const HostItem& item : report.items)
      assert_true((item.finding == HostFinding::kHurts) ==
                      (std::string_view(file.item) == item.name) ||
                  std::string_view(file.path) == "/proc/self/limits");
    assert_true(report.fit() == (item_of(report, file.item).need == Need::kBetter));
    tree.remove_all();
  }
}

void an_item_that_cannot_be_read_is_unknown_and_does_not_hurt(void**) {
  for (const HostFile& file : kHostFiles) {
    HostTree tree;
    tree.remove(file.path);
    expect(tree, file.item, HostFinding::kUnknown, "not readable");
    assert_true(inspect_host({tree.root(), kCpu, 80}).fit());
    tree.remove_all();
  }
  const HostReport nothing = inspect_host({"/there/is/none", kCpu, 80, "eth1", nullptr});
  for (const HostItem& item : nothing.items) {
    assert_true(item.finding == HostFinding::kUnknown);
    assert_true(std::string_view(item.value).substr(0, 12) == "not readable");
  }
  assert_int_equal(nothing.unknown(), nothing.items.size());
}

void the_kernel_may_also_say_that_it_is_real_time_in_a_file_of_its_own(void**) {
  HostTree tree;
  tree.put("/proc/sys/kernel/version", "#1 SMP\n");
  tree.put("/sys/kernel/realtime", "1\n");
  expect(tree, "kernel", HostFinding::kOk, "#1 SMP");
  tree.put("/sys/kernel/realtime", "0\n");
  expect(tree, "kernel", HostFinding::kHurts, "#1 SMP");
  tree.remove_all();
}

void a_capability_stands_for_the_limit(void**) {
  HostTree tree;
  tree.put("/proc/self/limits", "Max locked memory 0 0 bytes\nMax realtime priority 0 0\n");
  tree.put("/proc/self/status", "Name:\ttactus\nCapEff:\t0000000000804000\n");  // bits 14 and 23
  expect(tree, "priority", HostFinding::kOk, "CAP_SYS_NICE");
  expect(tree, "memory lock", HostFinding::kOk, "CAP_IPC_LOCK");
  tree.put("/proc/self/status", "Name:\ttactus\nCapEff:\t0000000000800000\n");
  expect(tree, "memory lock", HostFinding::kHurts, "RLIMIT_MEMLOCK 0");
  tree.put("/proc/self/status", "CapEff:\t000001ffff7fbfff\n");  // all but the two
  expect(tree, "priority", HostFinding::kHurts, "RLIMIT_RTPRIO 0");
  expect(tree, "memory lock", HostFinding::kHurts, "RLIMIT_MEMLOCK 0");
  tree.remove_all();
}

void where_an_interrupt_really_goes_counts_before_where_it_may_go(void**) {
  HostTree tree;
  tree.put("/proc/irq/25/smp_affinity_list", "0-3\n");
  tree.put("/proc/irq/25/effective_affinity_list", "1\n");
  tree.put("/proc/irq/default_smp_affinity", "f\n");
  expect(tree, "interrupts", HostFinding::kOk, "0 of 2 on cpu2");
  tree.put("/proc/irq/25/effective_affinity_list", "2\n");
  expect(tree, "interrupts", HostFinding::kHurts, "1 of 2 on cpu2: 25");
  tree.remove_all();
}

void without_a_cpu_every_cpu_counts(void**) {
  HostTree tree;
  const HostQuery any = {tree.root(), -1, 80};
  const char* smt = "/sys/devices/system/cpu/smt/active";
  tree.put(smt, "0\n");
  assert_true(item_of(inspect_host(any), "governor").finding == HostFinding::kOk);
  assert_true(item_of(inspect_host(any), "SMT").finding == HostFinding::kOk);
  assert_true(item_of(inspect_host(any), "isolated CPUs").finding == HostFinding::kOk);
  assert_true(item_of(inspect_host(any), "interrupts").finding == HostFinding::kUnknown);
  assert_true(item_of(inspect_host(any), "cpuset").finding == HostFinding::kUnknown);
  tree.put(smt, "1\n");
  tree.put("/sys/devices/system/cpu/cpu7/cpufreq/scaling_governor", "schedutil\n");
  assert_true(item_of(inspect_host(any), "SMT").finding == HostFinding::kHurts);
  assert_true(item_of(inspect_host(any), "governor").finding == HostFinding::kHurts);
  tree.remove_all();
}

void lists_of_cpus_are_read_as_the_kernel_writes_them(void**) {
  for (const int cpu : {0, 1, 2, 3, 5, 64}) assert_true(lists_cpu("0-3,5,64-127", cpu));
  for (const int cpu : {4, 6, 63, 128, -1}) assert_false(lists_cpu("0-3,5,64-127", cpu));
  for (const char* text : {"", "(null)", "-", ",", "a-b", "99999999999"})
    assert_false(lists_cpu(text, 0));
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_host_in_order_is_fit_and_every_item_is_ok),
      cmocka_unit_test(each_item_hurts_alone_when_its_file_says_so),
      cmocka_unit_test(an_item_that_cannot_be_read_is_unknown_and_does_not_hurt),
      cmocka_unit_test(the_kernel_may_also_say_that_it_is_real_time_in_a_file_of_its_own),
      cmocka_unit_test(a_capability_stands_for_the_limit),
      cmocka_unit_test(where_an_interrupt_really_goes_counts_before_where_it_may_go),
      cmocka_unit_test(without_a_cpu_every_cpu_counts),
      cmocka_unit_test(lists_of_cpus_are_read_as_the_kernel_writes_them),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
