// Verdict: why a reference was refused.
#pragma once

#include "kernel/status.hpp"

namespace tactus {

/// Why something was refused: which waypoint and axis (-1: none in particular), the value and the
/// limit it broke.
struct Verdict {
  Status status = Status::kOk;
  int waypoint = -1;
  int axis = -1;
  double value = 0.0, limit = 0.0;

  bool ok() const { return status == Status::kOk; }
};

}  // namespace tactus
