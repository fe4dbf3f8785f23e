// The network card of the robot, on hosts made of files, with an answer of the card that a test
// chooses.
#include <linux/ethtool.h>
#include <linux/sockios.h>
#include <net/if.h>

#include <cerrno>

#include "tests/hal/os/host_tree.hpp"

namespace tactus {
namespace {

constexpr int kCpu = 2;
constexpr const char* kStat50 =
    "77 (irq/30-eth1 (x) y) S 2 0 0 0 -1 2129984 0 0 0 0 0 0 0 0 -51 0 1 0 37 0 0 "
    "18446744073709551615 0 0 0 0 0 0 0 2147483647 0 1 0 0 17 0 50 1 0 0 0 0 0 0 0 0 0 0 0\n";
constexpr const char* kStat70 =
    "77 (irq/30-eth1 (x) y) S 2 0 0 0 -1 2129984 0 0 0 0 0 0 0 0 -71 0 1 0 37 0 0 "
    "18446744073709551615 0 0 0 0 0 0 0 2147483647 0 1 0 0 17 0 70 1 0 0 0 0 0 0 0 0 0 0 0\n";

ethtool_coalesce answer;  // of the card
int error = 0;            // of the request, instead

int ask(int, unsigned long request, void* argument) {
  auto& told = *static_cast<ifreq*>(argument);
  auto& coalesce = *reinterpret_cast<ethtool_coalesce*>(told.ifr_data);
  assert_int_equal(request, SIOCETHTOOL);
  assert_string_equal(told.ifr_name, "eth1");
  assert_int_equal(coalesce.cmd, ETHTOOL_GCOALESCE);
  coalesce = answer;
  errno = error;
  return error == 0 ? 0 : -1;
}

/// A host with a card that has interrupt 30.
class CardTree : public HostTree {
 public:
  CardTree() {
    answer = {};
    error = 0;
    put("/sys/class/net/eth1/device/msi_irqs/30", "msi\n");
    put("/proc/irq/30/smp_affinity_list", "0-1\n");
    put("/proc/77/comm", "irq/30-eth1\n");
    put("/proc/77/stat", kStat70);
    put("/proc/78/comm", "irq/31-ahci\n");
    put("/proc/sys/net/core/busy_poll", "50\n");
  }
  void expect(const char* name, HostFinding finding, std::string_view value, int cpu = kCpu) const {
    HostTree::expect({root(), cpu, 80, "eth1", ask}, name, finding, value);
  }
};

// Proves RT-5.

void a_card_in_order_leaves_nothing_unknown(void**) {
  const CardTree tree;
  const HostReport report = inspect_host({tree.root(), kCpu, 80, "eth1", ask});
  for (const HostItem& item : report.items) {
    if (item.finding != HostFinding::kOk) print_error("%s: %s\n", item.name, item.value.c_str());
    assert_true(item.finding == HostFinding::kOk);
  }
  assert_int_equal(report.unknown(), 0);
  tree.remove_all();
}

void the_interrupt_thread_must_be_above_those_of_other_devices(void**) {
  CardTree tree;
  tree.expect("card priority", HostFinding::kOk, "priority 70 for interrupt 30");
  tree.put("/proc/79/comm", "irq/32-eth1\n");
  tree.put("/proc/79/stat", kStat50);  // of another card's interrupt
  tree.expect("card priority", HostFinding::kOk, "priority 70 for interrupt 30");
  tree.put("/sys/class/net/eth1/device/msi_irqs/32", "msi\n");
  tree.expect("card priority", HostFinding::kHurts, "priority 50 for interrupt 32");
  tree.put("/proc/79/stat", "79 (irq/32-eth1) S 2\n");
  tree.expect("card priority", HostFinding::kUnknown, "not readable");
  tree.remove("/proc/77/comm");
  tree.remove("/proc/79/comm");
  tree.expect("card priority", HostFinding::kHurts, "no thread for interrupts 30 32");
  tree.remove_all();
}

void no_interrupt_of_the_card_may_be_on_the_cycles_cpu(void**) {
  CardTree tree;
  tree.expect("card affinity", HostFinding::kOk, "0 of 1 on cpu2");
  tree.put("/proc/irq/30/smp_affinity_list", "0-3\n");
  tree.expect("card affinity", HostFinding::kHurts, "1 of 1 on cpu2: 30");
  tree.put("/proc/irq/30/effective_affinity_list", "1\n");
  tree.expect("card affinity", HostFinding::kOk, "0 of 1 on cpu2");
  tree.expect("card affinity", HostFinding::kUnknown, "no CPU is chosen", -1);
  tree.remove_all();
}

void a_card_may_have_its_interrupts_at_the_bus_or_one_by_a_line(void**) {
  CardTree tree;
  tree.remove("/sys/class/net/eth1/device/msi_irqs/30");
  tree.expect("card affinity", HostFinding::kUnknown, "not readable");
  tree.expect("card priority", HostFinding::kUnknown, "not readable");
  tree.put("/sys/class/net/eth1/device/irq", "30\n");
  tree.expect("card affinity", HostFinding::kOk, "0 of 1 on cpu2");
  tree.put("/sys/class/net/eth1/msi_irqs/24", "msi\n");  // the folder above that of the device
  tree.put("/proc/irq/24/smp_affinity_list", "2\n");
  tree.expect("card affinity", HostFinding::kHurts, "1 of 1 on cpu2: 24");
  tree.remove_all();
}

void an_interrupt_that_waits_for_more_packets_hurts(void**) {
  struct Row {
    unsigned adaptive, usecs, frames;
    HostFinding finding;
    const char* value;
  };
  const Row rows[] = {
      {0, 0, 0, HostFinding::kOk, "adaptive-rx off, rx-usecs 0, rx-frames 0"},
      {0, 0, 1, HostFinding::kOk, "adaptive-rx off, rx-usecs 0, rx-frames 1"},
      {0, 8, 1, HostFinding::kOk, "adaptive-rx off, rx-usecs 8, rx-frames 1"},
      {0, 8, 0, HostFinding::kHurts, "adaptive-rx off, rx-usecs 8, rx-frames 0"},
      {0, 8, 32, HostFinding::kHurts, "adaptive-rx off, rx-usecs 8, rx-frames 32"},
      {0, 0, 32, HostFinding::kHurts, "adaptive-rx off, rx-usecs 0, rx-frames 32"},
      {1, 0, 0, HostFinding::kHurts, "adaptive-rx on, rx-usecs 0, rx-frames 0"},
  };
  const CardTree tree;
  for (const Row& row : rows) {
    answer.use_adaptive_rx_coalesce = row.adaptive;
    answer.rx_coalesce_usecs = row.usecs;
    answer.rx_max_coalesced_frames = row.frames;
    tree.expect("coalescing", row.finding, row.value);
  }
  error = EOPNOTSUPP;
  tree.expect("coalescing", HostFinding::kUnknown, "not readable: Operation not supported");
  tree.remove_all();
}

void a_kernel_that_does_not_look_for_packets_hurts(void**) {
  CardTree tree;
  tree.put("/proc/sys/net/core/busy_poll", "0\n");
  tree.expect("busy poll", HostFinding::kHurts, "busy_poll 0");
  tree.remove("/proc/sys/net/core/busy_poll");
  tree.expect("busy poll", HostFinding::kUnknown, "not readable: No such file or directory");
  tree.remove_all();
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_card_in_order_leaves_nothing_unknown),
      cmocka_unit_test(the_interrupt_thread_must_be_above_those_of_other_devices),
      cmocka_unit_test(no_interrupt_of_the_card_may_be_on_the_cycles_cpu),
      cmocka_unit_test(a_card_may_have_its_interrupts_at_the_bus_or_one_by_a_line),
      cmocka_unit_test(an_interrupt_that_waits_for_more_packets_hurts),
      cmocka_unit_test(a_kernel_that_does_not_look_for_packets_hurts),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
