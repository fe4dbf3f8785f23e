// Lease and StopCount: which client may move the arm, and whether its request is still valid.
#pragma once

#include <cstdint>

#include "gateway/server/limits.hpp"

namespace tactus {

enum class LeaseResult : std::uint8_t {
  kFree,       ///< it was free
  kRenewed,    ///< the client had it
  kTakenOver,  ///< another one of lower priority had it
  kRefused,    ///< another one has it
};

/// Owner of the motion of the arm: one client at a time; docs/gateway.md has the table.
class Lease {
 public:
  static constexpr int kNoOwner = -1;

  int owner() const { return owner_; }
  std::uint32_t priority() const { return priority_; }

  /// Requests the motion for a client, or renews its lease with another priority and timeout.
  LeaseResult take(int client, std::uint32_t priority, std::int64_t timeout_ns,
                   std::int64_t now_ns) {
    const LeaseResult taken = owner_ == kNoOwner     ? LeaseResult::kFree
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
  /// Extends the lease after a message of the client.
  void heard(int client, std::int64_t now_ns) {
    if (client == owner_) until_ns_ = now_ns + timeout_ns_;
  }
  /// True if the owner's time has passed.
  bool expired(std::int64_t now_ns) const { return owner_ != kNoOwner && now_ns > until_ns_; }
  void end() { owner_ = kNoOwner; }

 private:
  int owner_ = kNoOwner;
  std::uint32_t priority_ = 0;
  std::int64_t timeout_ns_ = 0, until_ns_ = 0;
};

/// Numbers the events that stop the arm or slow it down. A request to move again names the number
/// that its client had last received: a request that was under way when another client stopped the
/// arm must not undo the stop.
class StopCount {
 public:
  /// Stand-in for a stop by no client, such as a fault.
  static constexpr std::uint64_t kNoSession = 0;

  /// The arm was stopped or slowed down by the client of a session.
  void add(std::uint64_t by) {
    if (by != newest_by_) others_ = newest_;
    newest_by_ = by;
    ++newest_;
  }
  /// Number of the newest stop; 1: no stop so far.
  std::uint32_t newest() const { return newest_; }
  /// True if this number has been issued.
  bool issued(std::uint32_t number) const { return number >= 1 && number <= newest_; }
  /// True if a client that received this number has received all stops by others.
  bool known(std::uint32_t number, std::uint64_t session) const {
    return issued(number) && number >= (newest_by_ == session ? others_ : newest_);
  }

 private:
  std::uint32_t newest_ = 1, others_ = 1;  // others_: of the newest by another than newest_by_
  std::uint64_t newest_by_ = kNoSession;
};

}  // namespace tactus
