// Tuning: a set of parameters on its way to a running pipeline. The sender owns the copies of the
// blocks with the new parameters, and must not change them before the verdict.
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
