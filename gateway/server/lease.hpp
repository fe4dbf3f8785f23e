// Lease: who owns the motion of the arm. One client at a time does; docs/gateway.md has the table.
#pragma once

#include "gateway/server/limits.hpp"

namespace tactus {

enum class LeaseTaken : std::uint8_t {
  kFree,       ///< nobody had it
  kRenewed,    ///< the client had it
  kTakenOver,  ///< another one of lower priority had it
  kRefused,    ///< another one has it
};

class Lease {
 public:
  static constexpr int kNobody = -1;

  int owner() const { return owner_; }
  std::uint32_t priority() const { return priority_; }

  /// A client asks for the motion, or renews its lease with another priority and time.
  LeaseTaken take(int client, std::uint32_t priority, std::int64_t timeout_ns,
                  std::int64_t now_ns) {
    const LeaseTaken taken = owner_ == kNobody      ? LeaseTaken::kFree
                             : owner_ == client     ? LeaseTaken::kRenewed
                             : priority > priority_ ? LeaseTaken::kTakenOver
                                                    : LeaseTaken::kRefused;
    if (taken == LeaseTaken::kRefused) return taken;
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

}  // namespace tactus
