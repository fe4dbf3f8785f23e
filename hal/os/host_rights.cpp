// The items of a host that are rights of the process.
#include "hal/os/host_items.hpp"

namespace tactus::host {
namespace {

/// True if the process has the capability with this number.
bool capable(const HostQuery& query, int capability) {
  SmallFile status;
  if (!read(query, "/proc/self/status", status)) return false;
  const std::string_view mask = status.line("CapEff:");  // hexadecimal, lowest digit last
  const std::size_t digit = static_cast<std::size_t>(capability) / 4;
  if (digit >= mask.size()) return false;
  constexpr std::string_view kDigits = "0123456789abcdef";
  const std::size_t value = kDigits.find(mask[mask.size() - 1 - digit]);
  return value != std::string_view::npos && ((value >> (capability % 4)) & 1U) != 0;
}

}  // namespace

Content priority(const HostQuery& query) {
  constexpr int kSysNice = 23;  // CAP_SYS_NICE, linux/capability.h
  SmallFile limits;
  if (capable(query, kSysNice)) return {HostFinding::kOk, Text<127>("CAP_SYS_NICE")};
  if (!read(query, "/proc/self/limits", limits)) return unreadable(limits);
  const std::string_view limit = first_word(limits.line("Max realtime priority"));
  if (limit.empty()) return {HostFinding::kUnknown, Text<127>("not readable: no RLIMIT_RTPRIO")};
  return judge(limit == "unlimited" || leading_int(limit) >= query.priority,
               Text<127>("RLIMIT_RTPRIO ") << limit << ", wanted " << query.priority);
}

Content memory_lock(const HostQuery& query) {
  constexpr int kIpcLock = 14;  // CAP_IPC_LOCK
  SmallFile limits;
  if (capable(query, kIpcLock)) return {HostFinding::kOk, Text<127>("CAP_IPC_LOCK")};
  if (!read(query, "/proc/self/limits", limits)) return unreadable(limits);
  const std::string_view limit = first_word(limits.line("Max locked memory"));
  if (limit.empty()) return {HostFinding::kUnknown, Text<127>("not readable: no RLIMIT_MEMLOCK")};
  return judge(limit == "unlimited", Text<127>("RLIMIT_MEMLOCK ") << limit);
}

}  // namespace tactus::host
