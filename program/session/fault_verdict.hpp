// The fault that ended the cycles, from the kernel: joint or axis, value and limit.
#pragma once

#include "gateway/verdict_text.hpp"
#include "kernel/pipeline/pipeline.hpp"

namespace tactus {

/// Returns what the guard has found, or of a reference that is not held (kPathTolerance) the block
/// that watches it; `status` alone if neither has more. [between two cycles]
FaultVerdict fault_verdict(Status status, const Guard& guard, const Pipeline& pipeline);

}  // namespace tactus
