// Tuning: a set of parameters on its way to a pipeline that runs. Whoever prepares it owns the
// copies of the blocks that have the new parameters, and leaves them alone until the verdict.
#pragma once

#include <array>

#include "kernel/core/verdict.hpp"
#include "kernel/pipeline/timing.hpp"

namespace tactus {

struct Tuning {
  /// A copy of each block with the new parameters; null: it keeps its own.
  std::array<const void*, kMaxBlocks> copies{};
};

/// kOk, or why a block refuses the set.
struct TuningVerdict : Verdict {
  int block = -1;
};

}  // namespace tactus
