// Times in nanoseconds, the unit of stamps and of integer times passed to the operating system.
#pragma once

#include <cstdint>

namespace tactus {

inline constexpr std::int64_t kMillisecond_ns = 1'000'000, kSecond_ns = 1'000'000'000;

}  // namespace tactus
