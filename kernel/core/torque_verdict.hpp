// TorqueVerdict: the result of judging torques.
#pragma once

#include "kernel/core/status.hpp"

namespace tactus {

/// kOk, or what is wrong: the joint (-1: none in particular), its torque and the limit, N m.
struct TorqueVerdict {
  Status status = Status::kOk;
  int joint = -1;
  double value = 0.0, limit = 0.0;
};

}  // namespace tactus
