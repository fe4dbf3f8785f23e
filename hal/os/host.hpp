// Host: reads from /proc, /sys and the network card which settings of this Linux host would hurt a
// real-time cycle, and changes none of them.
#pragma once

#include <array>
#include <cstdint>

#include "hal/os/ioctl.hpp"
#include "kernel/core/text.hpp"

namespace tactus {

enum class HostFinding : std::uint8_t { kOk, kHurts, kUnknown };

constexpr const char* name(HostFinding finding) {
  switch (finding) {
    case HostFinding::kOk: return "ok";
    case HostFinding::kHurts: return "hurts";
    case HostFinding::kUnknown: return "unknown";
  }
  return nullptr;
}

/// How much an item matters.
enum class Need : std::uint8_t {
  kBetter,  ///< improves latencies
  kRight,   ///< no bound on the latency without it; a start requests it and reads it back
  kHost     ///< no bound on the latency without it; a start can only look
};

constexpr const char* name(Need need) {
  switch (need) {
    case Need::kBetter: return "better";
    case Need::kRight:
    case Need::kHost: return "required";
  }
  return nullptr;
}

struct HostQuery {
  const char* root = "";         ///< folder that contains proc and sys; empty: this host's own
  int cpu = -1;                  ///< CPU of the cycle; -1: any
  int priority = 80;             ///< priority of the cycle
  const char* interface = "";    ///< network interface of the robot; empty: none
  Ioctl ethtool = system_ioctl;  ///< queries the network card; null: no query is possible
};

struct HostItem {
  const char* name = "";
  Need need = Need::kBetter;
  HostFinding finding = HostFinding::kUnknown;
  Text<127> value;          ///< the present setting, or why it is unknown
  const char* place = "";   ///< where it is read
  const char* reason = "";  ///< what it does to a cycle when it hurts
  const char* remedy = "";  ///< how to change it
};

struct HostReport {
  std::array<HostItem, 22> items;

  /// False if an item hurts without which no bound on the latency can be expected.
  bool fit() const;
  /// Returns the number of items that are unknown.
  int unknown() const;
};

/// Inspects every item; one that cannot be read is unknown. [init]
HostReport inspect_host(const HostQuery& query);

}  // namespace tactus
