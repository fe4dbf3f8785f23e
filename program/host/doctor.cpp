#include "program/host/doctor.hpp"

#include <cstdio>

#include "hal/os/host.hpp"

namespace tactus {
namespace {

void print(const HostItem& item) {
  constexpr int kIndent = 26;
  std::printf("%-8s %-16s %-9s %s\n", name(item.finding), item.name, name(item.need),
              item.value.c_str());
  if (item.finding == HostFinding::kOk) return;
  std::printf("%*s%s: %s\n%*s-> %s\n", kIndent, "", item.place, item.reason, kIndent, "",
              item.remedy);
}

}  // namespace

int doctor(const Options& options) {
  HostQuery query = {options.root, options.cpu, options.priority, options.interface};
  if (options.root[0] != '\0') query.ethtool = nullptr;  // the card would be this host's
  const HostReport report = inspect_host(query);
  for (const HostItem& item : report.items) print(item);
  std::printf("%s", report.fit()
                        ? "No required setting is known to hurt real time"
                        : "A required setting hurts real time: expect no bound on latency");
  if (const int unknown = report.unknown(); unknown > 0)
    std::printf("; %d %s unknown", unknown, unknown == 1 ? "is" : "are");
  std::printf(".\n");
  return report.fit() ? kSucceeded : kEndedOtherwise;
}

}  // namespace tactus
