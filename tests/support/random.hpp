// Repeatable random numbers.
#pragma once

#include <cstdint>

namespace tactus {

/// Repeatable random numbers; the state is the seed.
struct Random {
  std::uint64_t state;
  /// Uniform in [lo, hi].
  double uniform(double lo, double hi) {
    state = state * 6364136223846793005U + 1442695040888963407U;
    return lo + (hi - lo) * static_cast<double>(state >> 11) * 0x1p-53;
  }
  int below(int n) { return static_cast<int>(uniform(0.0, n - 1e-9)); }
};

}  // namespace tactus
