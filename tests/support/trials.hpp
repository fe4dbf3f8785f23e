// How often tests with random or enumerated cases try.
#pragma once

#include <cstdio>
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

/// The number that TACTUS_TRIALS asks for, at least 1; `ordinary` without it. `make test-long` sets
/// it.
inline int trials(int ordinary) {
  const char* wanted = std::getenv("TACTUS_TRIALS");
  if (wanted == nullptr) return ordinary;
  char* end = nullptr;
  const long number = std::strtol(wanted, &end, 10);
  if (*wanted == '\0' || *end != '\0' || number < 1 || number > 1'000'000'000) {
    std::fprintf(stderr, "TACTUS_TRIALS is '%s'; it must be a whole number, 1 to 10^9\n", wanted);
    std::exit(2);
  }
  return static_cast<int>(number);
}

}  // namespace tactus
