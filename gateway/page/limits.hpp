// The limits and time-outs of the page; docs/gateway.md lists them.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tactus {

inline constexpr int kMostBrowsers = 8;          ///< receiving events at the same time
inline constexpr int kMostPageConnections = 24;  ///< a browser opens up to six while it loads
inline constexpr std::size_t kConnectionBytes = 16 << 10;  ///< of libmicrohttpd for each of them
inline constexpr unsigned kConnectionWait_s = 5;           ///< without a byte received or sent
inline constexpr std::int64_t kLongestRequest_ns = 5'000'000'000;  ///< from accept to answer
inline constexpr std::int64_t kCrowdedRequest_ns = 500'000'000;  ///< the same, without a free place
inline constexpr std::size_t kCommandsPerSecond = 50;  ///< of all browsers, Stop not counted
inline constexpr std::int64_t kOldestSeen_ms = 1500;   ///< state that the giver of a command saw
inline constexpr std::int64_t kStopPeriod_ns = 1'000'000;   ///< Stops within it are one
inline constexpr std::size_t kLongestBody = 64;             ///< bytes of a POST
inline constexpr std::size_t kEventRingBytes = 256 << 10;   ///< that a browser may lag behind
inline constexpr int kSocketBytes = 64 << 10;               ///< that the system keeps for a browser
inline constexpr std::size_t kDescriptionBytes = 64 << 10;  ///< of robot and pipeline
inline constexpr int kStatePeriod_ms = 50, kPortPeriod_ms = 50;
inline constexpr std::int64_t kPing_ns = 2'000'000'000;

}  // namespace tactus
