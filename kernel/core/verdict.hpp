// Verdict: the result of judging a reference or parameters, with the reason of a refusal.
#pragma once

#include "kernel/core/status.hpp"

namespace tactus {

/// kOk, or the limit that was broken: the waypoint and the axis (-1: none in particular), the value
/// and the limit.
struct Verdict {
  Status status = Status::kOk;
  int waypoint = -1;
  int axis = -1;
  double value = 0.0, limit = 0.0;

  bool ok() const { return status == Status::kOk; }
};

}  // namespace tactus
