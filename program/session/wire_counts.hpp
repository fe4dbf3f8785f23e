// WireCounts: what the wire of a board has counted since its start-up, for the summary of a run.
#pragma once

#include <array>
#include <cstdint>

namespace tactus {

struct WireCount {
  const char* name = nullptr;  ///< null: there is none
  std::int64_t value = 0;
};
using WireCounts = std::array<WireCount, 5>;

}  // namespace tactus
