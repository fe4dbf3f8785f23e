// Refusals of what the robot says, in words.
#pragma once

#include <string_view>

#include "kernel/core/status.hpp"
#include "kernel/core/text.hpp"

namespace tactus::ur {

/// Returns `status` and says why. [init]
inline Status refuse(Message& why, Status status, std::string_view text) {
  why = Message(text);
  return status;
}

}  // namespace tactus::ur
