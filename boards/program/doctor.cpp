#include "boards/program/doctor.hpp"

#include <cstdio>

#include "hal/os/host.hpp"

namespace tactus {

int doctor(const Options& options) {
  const HostReport report = inspect_host({options.root, options.cpu, options.priority});
  for (const HostItem& item : report.items) {
    std::printf("%-8s %-14s %-9s %s", kFindingWords[static_cast<std::size_t>(item.finding)],
                item.name, item.required ? "required" : "better", item.value.c_str());
    if (item.finding != Finding::kOk) std::printf("\n%*s-> %s", 24, "", item.remedy);
    std::printf("\n");
  }
  std::printf("%s\n", report.fit() ? "Nothing that is required is known to hurt."
                                   : "Something that is required hurts: expect no bound.");
  return report.fit() ? kSucceeded : kEndedOtherwise;
}

}  // namespace tactus
