// The limits and time-outs of the page; docs/gateway.md lists them.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tactus {

inline constexpr int kMostBrowsers = 8;          ///< that are told what happens, at once
inline constexpr int kMostPageConnections = 24;  ///< a browser opens up to six while it loads
inline constexpr std::size_t kConnectionBytes = 16 << 10;  ///< of libmicrohttpd for each of them
inline constexpr unsigned kConnectionWait_s = 5;           ///< without a byte that comes or goes
inline constexpr std::size_t kLongestBody = 64;            ///< bytes of a POST
inline constexpr std::size_t kNewsBytes = 256 << 10;  ///< that the slowest browser may lag behind
inline constexpr int kSocketBytes = 64 << 10;         ///< that the system keeps for a browser
inline constexpr std::size_t kDescriptionBytes = 64 << 10;  ///< of robot and pipeline
inline constexpr int kStatePeriod_ms = 50, kPortPeriod_ms = 50;
inline constexpr std::int64_t kPing_ns = 2'000'000'000;

}  // namespace tactus
