// The items of a host that are settings of its kernel.
#include "hal/os/host_items.hpp"

namespace tactus::host {
namespace {

/// Judges a file that has to hold one value; `name` precedes the value shown.
Content expect(const HostQuery& query, const char* path, const char* name, std::string_view good) {
  SmallFile file;
  if (!read(query, path, file)) return unreadable(file);
  return judge(file.text() == good, Text<127>(name) << " " << file.text());
}

}  // namespace

Content kernel(const HostQuery& query) {
  SmallFile realtime, release;
  if (!read(query, "/proc/sys/kernel/version", release)) return unreadable(release);
  const bool marked = read(query, "/sys/kernel/realtime", realtime) && realtime.text() == "1";
  return judge(marked || has(release.text(), "PREEMPT_RT"), release.text());
}

Content clock_source(const HostQuery& query) {
  SmallFile file;
  if (!read(query, "/sys/devices/system/clocksource/clocksource0/current_clocksource", file))
    return unreadable(file);
  const std::string_view source = file.text();
  return judge(source == "tsc" || source == "arch_sys_counter" || source == "kvm-clock", source);
}

Content throttling(const HostQuery& query) {
  return expect(query, "/proc/sys/kernel/sched_rt_runtime_us", "sched_rt_runtime_us", "-1");
}

Content timer_migration(const HostQuery& query) {
  return expect(query, "/proc/sys/kernel/timer_migration", "timer_migration", "0");
}

Content nmi_watchdog(const HostQuery& query) {
  return expect(query, "/proc/sys/kernel/nmi_watchdog", "nmi_watchdog", "0");
}

/// The file lists all modes and has the present one in brackets.
Content huge_pages(const HostQuery& query) {
  SmallFile file;
  if (!read(query, "/sys/kernel/mm/transparent_hugepage/enabled", file)) return unreadable(file);
  return judge(has(file.text(), "[never]") || has(file.text(), "[madvise]"), file.text());
}

Content swap(const HostQuery& query) {
  SmallFile file;
  if (!read(query, "/proc/swaps", file)) return unreadable(file);
  const std::size_t header = file.text().find('\n');  // a line of titles, then one per swap area
  if (header == std::string_view::npos) return {HostFinding::kOk, Text<127>("none")};
  return {HostFinding::kHurts, Text<127>(first_word(file.text().substr(header + 1)))};
}

Content machine(const HostQuery& query) {
  SmallFile cpu, vendor;
  if (!read(query, "/proc/cpuinfo", cpu)) return unreadable(cpu);
  const std::string_view flags = cpu.line("flags");
  if (flags.empty()) return {HostFinding::kUnknown, Text<127>("not readable: no flags, as on x86")};
  if (!has(flags, " hypervisor")) return {HostFinding::kOk, Text<127>("no hypervisor")};
  Text<127> value("virtual");
  if (read(query, "/sys/class/dmi/id/sys_vendor", vendor)) value << " (" << vendor.text() << ")";
  return {HostFinding::kHurts, value};
}

}  // namespace tactus::host
