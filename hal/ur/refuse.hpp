// Texts of refusals of reported robot properties.
#pragma once

#include <string_view>

#include "kernel/core/status.hpp"
#include "kernel/core/text.hpp"

namespace tactus::ur {

/// Returns `status`; sets the reason. [init]
inline Status refuse(Message& why, Status status, std::string_view text) {
  why = Message(text);
  return status;
}

}  // namespace tactus::ur
