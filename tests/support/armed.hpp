// The way of an executive from its start until the arm is commanded.
#pragma once

#include "kernel/cycle/executive.hpp"

namespace tactus {

/// Asks for the drives and runs cycles until they are taken over. `now_ns` is the time of the last
/// cycle before and after.
inline Status armed(Executive& executive, std::int64_t period_ns, std::int64_t& now_ns) {
  Status status = executive.arm();
  while (status == Status::kArming) {
    now_ns += period_ns;
    status = executive.cycle({now_ns});
    if (status == Status::kArming) status = executive.arm();
  }
  return status;
}

/// The same from the connection on.
inline Status start_armed(Executive& executive, std::int64_t period_ns, std::int64_t& now_ns) {
  TRY(executive.start());
  return armed(executive, period_ns, now_ns);
}

}  // namespace tactus
