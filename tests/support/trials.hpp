// How often tests with random or enumerated cases try.
#pragma once

#include <cstdlib>

namespace tactus {

/// `usual`, and with sanitizers `sanitized`: a case takes up to fourteen times as long then, and
/// undefined behaviour shows in each way through the code, not in a rare number.
constexpr int tries(int usual, [[maybe_unused]] int sanitized) {
#ifdef TACTUS_SANITIZED
  return sanitized;
#else
  return usual;
#endif
}

/// The number that TACTUS_TRIALS asks for; `ordinary` without it. `make test-long` sets it.
inline int trials(int ordinary) {
  const char* wanted = std::getenv("TACTUS_TRIALS");
  return wanted != nullptr ? std::atoi(wanted) : ordinary;
}

}  // namespace tactus
