// WireCounts: what the wire of a board has counted since its start-up, for the summary of a run.
#pragma once

#include <array>
#include <cstdint>

namespace tactus {

struct WireCount {
  const char* name = nullptr;  ///< null: there is none
  std::int64_t value = 0;
  std::int64_t most = -1;  ///< `value` to `most` is a range; -1: it is a number
};
using WireCounts = std::array<WireCount, 8>;

}  // namespace tactus
