// OrderModel: who owns the motion, what stops count and what may make the arm move again, as
// docs/gateway.md has it. It shares nothing with the server but the numbers of the messages.
#pragma once

#include <array>
#include <cassert>

#include "tests/gateway/server/client_bench.hpp"

namespace tactus {

/// A message of a client, without references.
struct Asked {
  std::uint32_t kind = 0;  ///< of `ask`; 0: none
  double rate = 0.0;       ///< of an override; of a lease, its priority, negative to give it back
};

struct OrderModel {
  static constexpr int kNoOwner = -1;
  static constexpr std::int64_t kLease_ns = 1000 * kMillisecond_ns;

  int owner = kNoOwner;  // by session
  int priority = 0;
  std::int64_t heard_ns = 0;
  std::array<int, 64> by{};     // by[k]: session that made stop k; kNoOwner: a fault, a lost lease
  std::uint32_t newest = 1;     // stop
  double seen_override = 1.0;   // as the server was told of it last
  double cycle_override = 1.0;  // as the cycle told it last
  int faults = 0;               // that the server has not been told of
  bool may_arm = false;         // by a Rearm that no Stop and no fault has followed
  bool may_resume = false;      // by a Resume that nothing which stops has followed
  bool resumed = false;         // by the cycle before, to which a Stop comes after it
  bool may_raise = false;       // by an Override that no lower one and no fault has followed
  bool stopped = false;         // by a Stop that no Rearm has followed
  bool paused = false;          // by a Pause that was executed
  double executed_override = 1.0;  // as reports say; negative: nobody was told

  void add_stop(int session) {
    assert(newest + 1 < by.size());
    by[++newest] = session;
  }
  bool raises(const Asked& asked) const {
    return asked.kind == ask::kOverride && asked.rate > seen_override;
  }
  bool known(int session, std::uint32_t told) const {
    for (std::uint32_t k = told + 1; k <= newest; ++k)
      if (by[k] != session) return false;
    return true;
  }
  /// The server has its turn: it is told of what the cycles have done.
  void begin_turn() {
    for (; faults > 0; --faults) add_stop(kNoOwner);
    seen_override = cycle_override;
  }
  /// The answer to a message whose client was told of stop `told`, and its effects.
  Status take(int session, const Asked& asked, std::uint32_t told, std::int64_t now_ns) {
    if (owner == session) heard_ns = now_ns;
    const bool moves = asked.kind == ask::kRearm || asked.kind == ask::kResume || raises(asked);
    if (moves && owner != session) return Status::kNotOwner;
    if (moves && (told < 1 || told > newest)) return Status::kBadValue;
    if (moves && !known(session, told)) return Status::kEpochVoid;
    if (asked.kind == ask::kLease) return take_lease(session, asked, now_ns);
    if (asked.kind == ask::kRearm) {
      may_arm = true;
      stopped = false;
    }
    if (asked.kind == ask::kResume) may_resume = true;
    if (moves && asked.kind == ask::kOverride) may_raise = true;
    if (!moves && asked.kind != ask::kPing) slow(session, asked);
    return Status::kOk;
  }
  void slow(int session, const Asked& asked) {
    add_stop(session);
    may_resume = may_resume && asked.kind == ask::kOverride;
    if (asked.kind == ask::kOverride) may_raise = false;
    if (asked.kind != ask::kStop) return;
    stopped = true;
    may_arm = false;
  }
  Status take_lease(int session, const Asked& asked, std::int64_t now_ns) {
    if (asked.rate < 0.0) {
      if (owner != session) return Status::kNotOwner;
      owner = kNoOwner;
      return Status::kOk;
    }
    const int wish = static_cast<int>(asked.rate);
    if (owner != kNoOwner && owner != session && wish <= priority) return Status::kNotOwner;
    owner = session;
    priority = wish;
    heard_ns = now_ns;
    return Status::kOk;
  }
  void end_turn(std::int64_t now_ns) {
    if (owner != kNoOwner && now_ns - heard_ns > kLease_ns) leave(owner);
  }
  void leave(int session) {
    if (owner != session) return;
    owner = kNoOwner;
    add_stop(kNoOwner);
  }
  /// Nobody is told any more of a control that was taken.
  void forget() {
    paused = false;
    executed_override = -1.0;
  }
  /// A fault in the cycle: what was asked for before counts no more, whoever knows of it.
  void fault() {
    ++faults;
    may_arm = may_resume = resumed = may_raise = false;
  }
};

}  // namespace tactus
