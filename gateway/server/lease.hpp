// Lease and StopCount: which client may move the arm, and whether its request is still valid.
#pragma once

#include <cstdint>

#include "gateway/server/limits.hpp"

namespace tactus {

enum class LeaseResult : std::uint8_t {
  kFree,       ///< no client had it
  kRenewed,    ///< the client had it
  kTakenOver,  ///< another one of lower priority had it
  kRefused,    ///< another one has it
};

/// Owner of the motion of the arm: one client at a time; docs/gateway.md has the table.
class Lease {
 public:
  static constexpr int kNobody = -1;

  int owner() const { return owner_; }
  std::uint32_t priority() const { return priority_; }

  /// A client asks for the motion, or renews its lease with another priority and time.
  LeaseResult take(int client, std::uint32_t priority, std::int64_t timeout_ns,
                   std::int64_t now_ns) {
    const LeaseResult taken = owner_ == kNobody      ? LeaseResult::kFree
                              : owner_ == client     ? LeaseResult::kRenewed
                              : priority > priority_ ? LeaseResult::kTakenOver
                                                     : LeaseResult::kRefused;
    if (taken == LeaseResult::kRefused) return taken;
    owner_ = client;
    priority_ = priority;
    timeout_ns_ = timeout_ns;
    heard(client, now_ns);
    return taken;
  }
  /// A message of a client has come.
  void heard(int client, std::int64_t now_ns) {
    if (client == owner_) until_ns_ = now_ns + timeout_ns_;
  }
  /// True if the owner's time has passed.
  bool expired(std::int64_t now_ns) const { return owner_ != kNobody && now_ns > until_ns_; }
  void end() { owner_ = kNobody; }

 private:
  int owner_ = kNobody;
  std::uint32_t priority_ = 0;
  std::int64_t timeout_ns_ = 0, until_ns_ = 0;
};

/// Numbers the events that stop the arm or slow it down. A request to move again names the number
/// that its client had last received: a request that was under way when another client stopped the
/// arm must not undo the stop.
class StopCount {
 public:
  /// By no client, as a fault.
  static constexpr std::uint64_t kNobody = 0;

  /// The arm was stopped or slowed down by the client of a session.
  void add(std::uint64_t by) {
    if (by != newest_by_) others_ = newest_;
    newest_by_ = by;
    ++newest_;
  }
  /// Number of the newest; it begins with 1, which is none.
  std::uint32_t newest() const { return newest_; }
  /// True if a client can have received this number.
  bool told(std::uint32_t number) const { return number >= 1 && number <= newest_; }
  /// True if a client that received this number knows of all stops but its own.
  bool known(std::uint32_t number, std::uint64_t session) const {
    return told(number) && number >= (newest_by_ == session ? others_ : newest_);
  }

 private:
  std::uint32_t newest_ = 1, others_ = 1;  // others_: of the newest by another than newest_by_
  std::uint64_t newest_by_ = kNobody;
};

}  // namespace tactus
