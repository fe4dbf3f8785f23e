// Host: what on this Linux host would hurt a real-time cycle, read from /proc and /sys and changed
// nowhere.
#pragma once

#include <array>
#include <cstdint>

#include "kernel/text.hpp"

namespace tactus {

enum class Finding : std::uint8_t { kOk, kHurts, kUnknown };
inline constexpr std::array<const char*, 3> kFindingWords = {"ok", "hurts", "unknown"};

struct HostQuery {
  const char* root = "";  ///< before /proc and /sys; empty: this host's own
  int cpu = -1;           ///< the one the cycle is to run on; -1: any
  int priority = 80;      ///< the one it is to run at
};

struct HostItem {
  const char* name = "";
  bool required = false;  ///< without it no bound on the latency can be expected
  Finding finding = Finding::kUnknown;
  Text<127> value;          ///< what was found
  const char* remedy = "";  ///< how to mend what hurts
};

struct HostReport {
  std::array<HostItem, 12> items;

  /// False if anything that is required hurts.
  bool fit() const;
};

/// Looks at every item; what cannot be read is unknown. [init]
HostReport inspect_host(const HostQuery& query);

}  // namespace tactus
