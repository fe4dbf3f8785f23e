// The limits and time-outs of the server of references; docs/gateway.md lists them.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/core/nanoseconds.hpp"

namespace tactus {

inline constexpr int kMostClients = 8;                    ///< connections at once
inline constexpr std::size_t kLengthBytes = 4;            ///< before each message
inline constexpr std::size_t kLongestMessage = 16 << 10;  ///< bytes without its length
inline constexpr std::size_t kLongestToClient = 2 << 10;  ///< of a message to a client
inline constexpr std::size_t kOutputBytes = 64 << 10;     ///< that wait to be sent to a client
inline constexpr std::size_t kReserveBytes = kOutputBytes / 2;  ///< of these, kept for reports
inline constexpr int kLongestPart = 60;                         ///< waypoints; tactus.options
inline constexpr int kStagedWaypoints = 256;                    ///< that wait for the window
inline constexpr int kMostUnreported = 128;  ///< references and controls without a final report

inline constexpr int kMessagesPerTurn = 32;      ///< of a client, then it is the others' turn
inline constexpr int kMessagesPerSecond = 5000;  ///< on average; more cut the client
inline constexpr int kMessageBurst = 5000;       ///< accepted at once

inline constexpr std::int64_t kHelloWait_ns = 5 * kSecond_ns;
inline constexpr std::int64_t kIdle_ns = 60 * kSecond_ns;     ///< with nothing but Pings
inline constexpr std::int64_t kSilence_ns = 15 * kSecond_ns;  ///< without a message
inline constexpr std::int64_t kStalled_ns = 2 * kSecond_ns;   ///< with bytes that are not read
inline constexpr std::int64_t kStampRange_ns = 10 * kSecond_ns;

inline constexpr std::uint32_t kShortestLease_ms = 20, kLongestLease_ms = 60'000,
                               kDefaultLease_ms = 1000, kHighestPriority = 255;

}  // namespace tactus
